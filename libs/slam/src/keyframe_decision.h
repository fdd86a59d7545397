/** When a frame becomes a keyframe. */
#pragma once
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Number of keypoints that a keyframe makes landmarks of at once. */
int keypointsWithDepth(const Frame& frame);

/** Relative motion, share of landmarks still tracked, and a minimum of visual change, after the
 *  criteria that RGB-D odometry compares (e.g. Kerl, Sturm and Cremers, IROS 2013; Mur-Artal and
 *  Tardos, T-RO 2017). */
class KeyframeDecision {
  public:
    explicit KeyframeDecision(const KeyframeOptions& options) : options_(options) {}

    /** \param frames_since_keyframe frames after the last keyframe, this one included */
    bool wants(const SlamMap& map, const LocatedFrame& located, int frames_since_keyframe);

    /** The keyframe whose view the last frames were compared with. */
    int reference() const { return keyframe_; }

    /** Compares with this keyframe from now on. */
    void reset(const Keyframe& keyframe);

    void save(ByteWriter& out) const;
    /** \param keyframes there are
     *  \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

  private:
    bool isFar(const SE3& motion, double median_depth_m) const;
    bool turnsToKnown(const SlamMap& map, const LocatedFrame& located);

    const KeyframeOptions& options_;
    int keyframe_ = 0;
    double median_depth_m_ = 1;
    int most_inliers_ = 0;
};

}  // namespace rgbd_graphslam
