#include "rgbd_graphslam/slam/relative_pose.h"

#include <cmath>

namespace rgbd_graphslam {

Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& phi) {
    const double theta = phi.norm();
    const Eigen::Matrix3d W = skew(phi);
    const double quadratic =
        theta < 1e-4 ? 1.0 / 12 : 1 / (theta * theta) - 1 / (2 * theta * std::tan(theta / 2));
    return Eigen::Matrix3d::Identity() - 0.5 * W + quadratic * W * W;
}

Vector6d relativePoseResidual(const SE3& T_world_from, const SE3& T_world_to,
                              const SE3& measured_from_to, Matrix6d* jacobian_to) {
    const SE3 T_measured_world = (T_world_from * measured_from_to).inverse();
    const SE3 error = T_measured_world * T_world_to;
    Vector6d residual;
    residual << error.t, rotationLog(error.R);
    if (jacobian_to) {
        const Eigen::Matrix3d& R = T_measured_world.R;
        *jacobian_to << R, -R * skew(T_world_to.t), Eigen::Matrix3d::Zero(),
            inverseLeftJacobian(residual.tail<3>()) * R;
    }
    return residual;
}

}  // namespace rgbd_graphslam
