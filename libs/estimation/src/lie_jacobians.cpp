#include "rgbd_graphslam/estimation/lie_jacobians.h"

#include <cmath>

namespace rgbd_graphslam {

Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& phi) {
    const double theta = phi.norm(), theta2 = theta * theta;
    const Eigen::Matrix3d W = skew(phi);
    if (theta < 1e-4) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6;
    return Eigen::Matrix3d::Identity() + (1 - std::cos(theta)) / theta2 * W +
           (theta - std::sin(theta)) / (theta2 * theta) * W * W;
}

Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& phi) {
    const double theta = phi.norm();
    const Eigen::Matrix3d W = skew(phi);
    const double quadratic =
        theta < 1e-4 ? 1.0 / 12 : 1 / (theta * theta) - 1 / (2 * theta * std::tan(theta / 2));
    return Eigen::Matrix3d::Identity() - 0.5 * W + quadratic * W * W;
}

Matrix6d adjoint(const SE3& T) {
    Matrix6d A;
    A << T.R, skew(T.t) * T.R, Eigen::Matrix3d::Zero(), T.R;
    return A;
}

}  // namespace rgbd_graphslam
