#include "rgbd_graphslam/estimation/heading_increment.h"

#include <cmath>

namespace rgbd_graphslam {

bool HeadingIncrement::linearize(const StateBlocks& states, Linearization& out) const {
    const Eigen::Matrix3d R_from_to = states.pose(0).R * states.pose(1).R.transpose();
    const Eigen::Vector3d ahead = R_from_to.col(0);
    const double turned_rad = yaw_rad_ - states.motion(2).gyro_bias.z() * duration_s_;
    using Residual = Eigen::Matrix<double, 1, 1>;
    out.setResidual(Residual(
        weight_ * std::remainder(std::atan2(ahead.y(), ahead.x()) - turned_rad, 2 * M_PI)));
    if (!out.wantsJacobians()) return true;
    const Eigen::RowVector3d by_ahead =
        Eigen::RowVector3d(-ahead.y(), ahead.x(), 0) / ahead.head<2>().squaredNorm();
    Eigen::Matrix<double, 1, 6> by_from = Eigen::Matrix<double, 1, 6>::Zero(), by_to = by_from;
    by_from.tail<3>() = -weight_ * by_ahead * skew(ahead);
    by_to.tail<3>() = weight_ * by_ahead * R_from_to * skew(Eigen::Vector3d::UnitX());
    Eigen::Matrix<double, 1, 9> by_motion = Eigen::Matrix<double, 1, 9>::Zero();
    by_motion(5) = weight_ * duration_s_;
    out.setJacobian(0, by_from);
    out.setJacobian(1, by_to);
    out.setJacobian(2, by_motion);
    return true;
}

}  // namespace rgbd_graphslam
