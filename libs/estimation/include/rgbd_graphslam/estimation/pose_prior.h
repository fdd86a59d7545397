/** A known pose, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** The residual is the tangent vector (m, rad, body frame) of T_body_world * T_prior^-1. */
class PosePrior final : public Factor {
  public:
    /** \param information inverse covariance of the tangent vector
     *  \throws Error when the information matrix is not positive definite */
    PosePrior(int keyframe, const SE3& T_body_world, const Matrix6d& information);

    std::vector<StateKey> states() const override { return {poseKey(keyframe_)}; }
    int residualSize() const override { return 6; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int keyframe_;
    SE3 prior_;
    Matrix6d whitening_;
};

}  // namespace rgbd_graphslam
