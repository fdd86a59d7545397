/** A measured pose of one keyframe in another, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** How far a pose is from its measurement: the tangent vector (m, rad) of measured^-1 * predicted.
 */
Vector6d relativePoseError(const SE3& predicted, const SE3& measured);

/** The residual is relativePoseError() of T_from_to, the pose of keyframe `to` in the frame of
 *  `from`. */
class RelativePose final : public Factor {
  public:
    /** \param information inverse covariance of the error
     *  \throws Error when the information matrix is not positive definite */
    RelativePose(int from, int to, const SE3& T_from_to, const Matrix6d& information,
                 const RobustKernel& kernel = {});

    std::vector<StateKey> states() const override { return {poseKey(from_), poseKey(to_)}; }
    int residualSize() const override { return 6; }
    RobustKernel kernel() const override { return kernel_; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int from_, to_;
    SE3 T_from_to_;
    Matrix6d whitening_;
    RobustKernel kernel_;
};

}  // namespace rgbd_graphslam
