/** How uncertain poses are, in the world and against the map. */
#pragma once
#include <vector>

#include "motion_prior.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Covariance of the left perturbation of a frame's T_cam_world against the map around it, by what
 *  located it. Errors of neighboring keypoints are alike, all depths of an image share an error,
 * and one patch serves many frames: the information of independent errors claims too much by a
 * factor found on some sequences and held on others (doc/design-decisions.md). */
Matrix6d covarianceAgainstMap(const LocatedFrame& located);

/** Of a pose by dead reckoning. */
Matrix6d covarianceOf(const PoseSpread& spread);

/** Standard deviations of the least certain direction, of position and of rotation. */
PoseSpread weakestDirection(const Matrix6d& covariance);

/** Of the first keyframe of a submap, which defines where that is. */
constexpr int no_reference = -1;

/** How uncertain a keyframe is against the one that it is tied to. */
struct KeyframeLink {
    enum class By { Landmarks, DeadReckoning } by = By::Landmarks;
    /** Of the weakest direction. */
    PoseSpread spread;
};

/** How uncertain keyframes are in the world. Uncertainty grows from keyframe to keyframe like a
 *  random walk, faster where few landmarks hold them, as these also share few with others over
 * which errors would average; a keyframe that sees older ones again is as certain as these. */
class MapUncertainty {
  public:
    /** \param keyframes of a map that is taken to be certain */
    void restore(std::size_t keyframes) { variances_.assign(keyframes, {}); }

    /** The next keyframe.
     *  \param reference that it was located by, or that dead reckoning began at, or no_reference
     *  \param T_reference_keyframe the motion between them
     *  \param link by landmarks that both see, or by dead reckoning */
    void add(int reference, const SE3& T_reference_keyframe, const KeyframeLink& link);

    /** A loop makes a keyframe as certain as the earlier one it sees again. */
    void closeLoop(int from, int to);

    /** Covariance of the left perturbation of a frame's T_cam_world in the world. */
    Matrix6d inWorld(const Matrix6d& against_map, int reference_keyframe) const;

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

  private:
    struct Variance {
        double m2 = 0, rad2 = 0;
    };
    std::vector<Variance> variances_;  // one per keyframe
};

}  // namespace rgbd_graphslam
