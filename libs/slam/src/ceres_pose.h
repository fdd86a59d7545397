/** SE3 as a parameter block of Ceres. */
#pragma once
#include <ceres/manifold.h>

#include <array>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A pose as Ceres sees it: rotation by columns, then translation. */
constexpr int pose_size = 12;
using PoseBlock = std::array<double, pose_size>;

template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;

inline SE3 poseOf(const double* block) {
    return {Eigen::Map<const Eigen::Matrix3d>(block), Eigen::Map<const Eigen::Vector3d>(block + 9)};
}

inline void store(const SE3& pose, double* block) {
    Eigen::Map<Eigen::Matrix3d> rotation(block);
    Eigen::Map<Eigen::Vector3d> translation(block + 9);
    rotation = pose.R;
    translation = pose.t;
}

/** SE3::retract for Ceres. Costs hand over derivatives by the tangent vector in the first six
 *  columns, so Plus' own derivative is the selection of these. */
class LeftPerturbation final : public ceres::Manifold {
  public:
    int AmbientSize() const override { return pose_size; }
    int TangentSize() const override { return 6; }
    bool Plus(const double* pose, const double* delta, double* moved) const override {
        store(poseOf(pose).retract(Eigen::Map<const Vector6d>(delta)), moved);
        return true;
    }
    bool PlusJacobian(const double*, double* jacobian) const override {
        Eigen::Map<RowMajor<pose_size, 6>>(jacobian).setIdentity();
        return true;
    }
    bool Minus(const double* moved, const double* pose, double* delta) const override {
        Eigen::Map<Vector6d>{delta} = poseOf(moved).minus(poseOf(pose));
        return true;
    }
    bool MinusJacobian(const double*, double* jacobian) const override {
        Eigen::Map<RowMajor<6, pose_size>>(jacobian).setIdentity();
        return true;
    }
};

}  // namespace rgbd_graphslam
