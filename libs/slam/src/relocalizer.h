/** Where a frame is that tracking has lost. */
#pragma once
#include <optional>
#include <vector>

#include "motion_prior.h"
#include "rgbd_graphslam/slam/loop_closer.h"

namespace rgbd_graphslam {

/** Where dead reckoning puts a frame. */
struct Prediction {
    SE3 T_cam_world;
    /** Part of the map that the pose belongs to. */
    int submap = 0;
    /** Up to this frame. */
    MotionPrior prior;
};

/** Compares all places that a frame may show with each other and with the motion since the map was
 *  seen last. What the motion confirms is believed at once; what it contradicts, never; places that
 *  look alike stay undecided; others must be seen well, or in several frames. */
class Relocalizer {
  public:
    /** All arguments must outlive it. \param tracker whose search of the local map is used */
    Relocalizer(const SlamOptions& options, const RigCameras& cameras, const SlamMap& map,
                const LoopCloser& places, Tracker& tracker)
        : options_(options), cameras_(cameras), map_(map), places_(places), tracker_(tracker) {}

    /** \param frame keypoints move to the landmarks that they show, if it is located
     *  \param predicted nothing where the camera may be anywhere
     *  \return nothing while no place is certain */
    std::optional<LocatedFrame> find(Frame& frame, const std::optional<Prediction>& predicted);

    /** What was supposed of earlier frames does not matter any more. */
    void forget() { supposed_.reset(); }

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** The map must be loaded. \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    /** A place that a frame may show. */
    struct Candidate {
        Frame frame;
        LocatedFrame located;
        int submap = 0;
        Agreement agreement = Agreement::Possible;
    };
    /** A place that the frames before may have shown, by one of its keyframes. */
    struct Supposition {
        int keyframe = 0;
        SE3 T_cam_keyframe;
        double stamp_s = 0;
        int frames = 0;
    };

    std::vector<int> keyframesAround(const Prediction& predicted) const;
    std::optional<Candidate> lookAround(const Frame& frame, const Prediction& predicted);
    std::optional<Candidate> lookAt(const Frame& frame, int keyframe,
                                    const std::optional<Prediction>& predicted);
    Candidate judged(Frame frame, LocatedFrame located,
                     const std::optional<Prediction>& predicted) const;
    const Candidate* likeliest(const std::vector<Candidate>& candidates) const;
    bool believes(const Candidate& candidate, bool after_a_loss);

    const SlamOptions& options_;
    const RigCameras& cameras_;
    const SlamMap& map_;
    const LoopCloser& places_;
    Tracker& tracker_;
    std::optional<Supposition> supposed_;
};

}  // namespace rgbd_graphslam
