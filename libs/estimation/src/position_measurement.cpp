#include "rgbd_graphslam/estimation/position_measurement.h"

namespace rgbd_graphslam {

bool PositionMeasurement::linearize(const StateBlocks& states, Linearization& out) const {
    const SE3 T_body_world = states.pose(0);
    const Eigen::Matrix3d R_world_body = T_body_world.R.transpose();
    const Eigen::Vector3d predicted = R_world_body * (lever_arm_ - T_body_world.t);
    out.setResidual(Eigen::Vector3d(weight_.cwiseProduct(position_ - predicted)));
    if (!out.wantsJacobians()) return true;
    // Perturbed on the left, the body's frame moves by (dt, dw): predicted changes by
    // R_world_body (-dt - dw x lever_arm).
    Eigen::Matrix<double, 3, 6> J;
    J << R_world_body, -R_world_body * skew(lever_arm_);
    out.setJacobian(0, Eigen::Matrix<double, 3, 6>(weight_.asDiagonal() * J));
    return true;
}

}  // namespace rgbd_graphslam
