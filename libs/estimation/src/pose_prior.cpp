#include "rgbd_graphslam/estimation/pose_prior.h"

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "rgbd_graphslam/estimation/whitening.h"

namespace rgbd_graphslam {

PosePrior::PosePrior(int keyframe, const SE3& T_body_world, const Matrix6d& information)
    : keyframe_(keyframe),
      prior_(T_body_world),
      whitening_(whiteningOf(information, "prior of keyframe " + std::to_string(keyframe))) {}

bool PosePrior::linearize(const StateBlocks& states, Linearization& out) const {
    const Vector6d error = states.pose(0).minus(prior_);
    out.setResidual(Vector6d(whitening_ * error));
    if (!out.wantsJacobians()) return true;
    Matrix6d J;
    J << Eigen::Matrix3d::Identity(), -skew(error.head<3>()), Eigen::Matrix3d::Zero(),
        inverseLeftJacobian(error.tail<3>());
    out.setJacobian(0, Matrix6d(whitening_ * J));
    return true;
}

}  // namespace rgbd_graphslam
