/** How uncertain poses are, in the world and against the map. */
#pragma once
#include <deque>
#include <optional>
#include <vector>

#include "motion_prior.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Covariance of the left perturbation of a frame's T_cam_world against the map around it, by what
 *  located it, as if errors were independent. MapUncertainty::scale() tells how far they are not.
 */
Matrix6d covarianceAgainstMap(const LocatedFrame& located);

/** Of a pose by dead reckoning. */
Matrix6d covarianceOf(const PoseSpread& spread);

/** Standard deviations of the least certain direction, of position and of rotation. */
PoseSpread weakestDirection(const Matrix6d& covariance);

/** Halves of a frame's landmarks (left and right, upper and lower, near and far) each tell a pose.
 *  Independent errors make the two differ as their covariances say; a wrong calibration, something
 *  that moves, or a lens that is not modelled makes them differ by more.
 *  \return squared Mahalanobis distance of the two poses over its expectation, mean of the
 * halvings: 1 where claims are right; nothing where a half has too few landmarks */
std::optional<double> disagreementOfHalves(const std::vector<PointMatch>& matches,
                                           const RigCameras& cameras, const LocatedFrame& located);

/** What a new keyframe knows its pose by. */
struct KeyframeTie {
    int keyframe = 0;
    SE3 T_new_keyframe;
    /** Of the left perturbation of the new pose against that keyframe. */
    Matrix6d covariance;
};

/** How uncertain keyframes are against the first one of their submap. A covariance is carried from
 *  keyframe to keyframe by the adjoint, so that an uncertain rotation makes what lies far ahead
 *  uncertain; of all keyframes that share landmarks with a new one, the tie that leaves it least
 *  uncertain counts. What the calibration gets wrong does not average out: it grows with the
 *  distance and the turn since the first keyframe, by a share that disagreementOfHalves() tells. */
class MapUncertainty {
  public:
    /** \param keyframes of a map that is taken to be certain */
    void restore(std::size_t keyframes);

    /** The next keyframe. \param ties none for the first keyframe of a submap */
    void add(const std::vector<KeyframeTie>& ties);

    /** A loop makes a keyframe as certain as the earlier one it sees again. */
    void closeLoop(int from, int to, const SE3& T_from_to);

    /** \param disagreement of a frame's halves; nothing changes without one */
    void note(const std::optional<double>& disagreement);

    /** Variance of poses over that of independent errors, at least 1: the median of the last
     *  disagreements. */
    double scale() const;

    /** Covariance of the left perturbation of a frame's T_cam_world in the world.
     *  \param T_cam_origin from the first keyframe of the submap */
    Matrix6d inWorld(const Matrix6d& against_map, int reference_keyframe,
                     const SE3& T_cam_reference, const SE3& T_cam_origin) const;

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

  private:
    std::vector<Matrix6d> covariances_;  // one per keyframe
    std::deque<double> disagreements_;
};

}  // namespace rgbd_graphslam
