/** Rigid motions in 3-D. `T_a_b` maps coordinates of frame b to frame a. */
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rgbd_graphslam {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** Rotation matrix of the vector w (rad), Rodrigues' formula. */
Eigen::Matrix3d rotationExp(const Eigen::Vector3d& w);

/** Inverse of rotationExp, |w| <= pi. */
Eigen::Vector3d rotationLog(const Eigen::Matrix3d& R);

/** The matrix with skew(a) b = a x b. */
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/** A rigid motion p -> R p + t. A tangent vector is (translation in m, rotation in rad); all
 *  derivatives in this project are with respect to a left perturbation,
 *  T(delta) = (rotationExp(delta_rotation), delta_translation) * T. */
struct SE3 {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();

    SE3() = default;
    SE3(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
        : R(rotation), t(translation) {}
    SE3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
        : R(rotation.normalized().toRotationMatrix()), t(translation) {}

    SE3 inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
    SE3 operator*(const SE3& other) const { return {R * other.R, R * other.t + t}; }
    Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return R * p + t; }

    /** Left-perturbed by a tangent vector, with the rotation re-orthonormalized so that errors do
     *  not grow over long products. */
    SE3 retract(const Vector6d& delta) const;

    /** Tangent vector with other.retract(...) == *this, to first order and beyond. */
    Vector6d minus(const SE3& other) const;

    Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(R).normalized(); }
    /** rad */
    double angle() const { return rotationLog(R).norm(); }
};

/** Nearest rotation to a matrix that has drifted by rounding. */
Eigen::Matrix3d orthonormalized(const Eigen::Matrix3d& R);

/** Between two poses: linear in translation, spherical-linear in rotation. \param share in [0, 1]
 */
SE3 interpolate(const SE3& from, const SE3& to, double share);

}  // namespace rgbd_graphslam
