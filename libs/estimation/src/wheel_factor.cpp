#include "rgbd_graphslam/estimation/wheel_factor.h"

#include <Eigen/LU>
#include <cmath>

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "rgbd_graphslam/estimation/whitening.h"

namespace rgbd_graphslam {
namespace {

using Matrix36d = Eigen::Matrix<double, 3, 6>;

/** Derivative of a rotation's yaw by the rotation's first column. */
Eigen::RowVector3d yawByColumn(const Eigen::Vector3d& column) {
    return Eigen::RowVector3d(-column.y(), column.x(), 0) / column.head<2>().squaredNorm();
}

}  // namespace

WheelFactor::WheelFactor(int from, int to, const WheelIncrement& increment, const SE3& T_base_body,
                         const RobustKernel& kernel)
    : from_(from),
      to_(to),
      measured_(increment.T_from_to),
      T_base_body_(T_base_body),
      whitening_(whiteningOf(Eigen::Matrix3d(increment.covariance.inverse()),
                             "wheel edge " + std::to_string(from) + " - " + std::to_string(to))),
      kernel_(kernel) {}

bool WheelFactor::linearize(const StateBlocks& states, Linearization& out) const {
    const SE3 T_from_to = T_base_body_ * states.pose(0) * (T_base_body_ * states.pose(1)).inverse();
    const Eigen::Vector3d ahead = T_from_to.R.col(0);
    const Eigen::Vector3d error(
        T_from_to.t.x() - measured_.x, T_from_to.t.y() - measured_.y,
        std::remainder(std::atan2(ahead.y(), ahead.x()) - measured_.yaw, 2 * M_PI));
    out.setResidual(Eigen::Vector3d(whitening_ * error));
    if (!out.wantsJacobians()) return true;
    Matrix36d by_from = Matrix36d::Zero(), by_to = Matrix36d::Zero();
    by_from.topRows<2>() << Eigen::Matrix3d::Identity().topRows<2>(),
        -skew(T_from_to.t).topRows<2>();
    by_from.block<1, 3>(2, 3) = -yawByColumn(ahead) * skew(ahead);
    by_to.topLeftCorner<2, 3>() = -T_from_to.R.topRows<2>();
    by_to.block<1, 3>(2, 3) = yawByColumn(ahead) * T_from_to.R * skew(Eigen::Vector3d::UnitX());
    const Matrix6d by_body = adjoint(T_base_body_);
    out.setJacobian(0, Matrix36d(whitening_ * by_from * by_body));
    out.setJacobian(1, Matrix36d(whitening_ * by_to * by_body));
    return true;
}

}  // namespace rgbd_graphslam
