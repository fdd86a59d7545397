#include "rgbd_graphslam/geometry/se3.h"

#include <cmath>

namespace rgbd_graphslam {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
    Eigen::Matrix3d m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

Eigen::Matrix3d rotationExp(const Eigen::Vector3d& w) {
    const double theta = w.norm();
    const Eigen::Matrix3d W = skew(w);
    if (theta < 1e-8) return Eigen::Matrix3d::Identity() + W + 0.5 * W * W;
    return Eigen::Matrix3d::Identity() + std::sin(theta) / theta * W +
           (1 - std::cos(theta)) / (theta * theta) * W * W;
}

Eigen::Vector3d rotationLog(const Eigen::Matrix3d& R) {
    const Eigen::Quaterniond q(R);
    const double n = q.vec().norm();
    const double w = std::abs(q.w());
    const double scale = n < 1e-10 ? 2.0 / w : 2.0 * std::atan2(n, w) / n;
    return (q.w() < 0 ? -scale : scale) * q.vec();
}

Eigen::Matrix3d orthonormalized(const Eigen::Matrix3d& R) {
    return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

SE3 SE3::retract(const Vector6d& delta) const {
    const Eigen::Matrix3d dR = rotationExp(delta.tail<3>());
    return {orthonormalized(dR * R), dR * t + delta.head<3>()};
}

Vector6d SE3::minus(const SE3& other) const {
    const SE3 difference = *this * other.inverse();
    Vector6d delta;
    delta << difference.t, rotationLog(difference.R);
    return delta;
}

SE3 interpolate(const SE3& from, const SE3& to, double share) {
    const Eigen::Quaterniond q = from.quaternion().slerp(share, to.quaternion());
    return {q, (1 - share) * from.t + share * to.t};
}

}  // namespace rgbd_graphslam
