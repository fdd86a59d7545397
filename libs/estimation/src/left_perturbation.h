/** Poses as parameter blocks of Ceres. */
#pragma once
#include <ceres/manifold.h>

#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** SE3::retract for Ceres. Factors give derivatives by the tangent vector in the first six columns,
 *  so the derivative of Plus is the selection of these. */
class LeftPerturbation final : public ceres::Manifold {
  public:
    int AmbientSize() const override { return pose_size; }
    int TangentSize() const override { return 6; }
    bool Plus(const double* pose, const double* delta, double* moved) const override {
        store(poseFrom(pose).retract(Eigen::Map<const Vector6d>(delta)), moved);
        return true;
    }
    bool PlusJacobian(const double*, double* jacobian) const override {
        Eigen::Map<RowMajor<pose_size, 6>>(jacobian).setIdentity();
        return true;
    }
    bool Minus(const double* moved, const double* pose, double* delta) const override {
        Eigen::Map<Vector6d>{delta} = poseFrom(moved).minus(poseFrom(pose));
        return true;
    }
    bool MinusJacobian(const double*, double* jacobian) const override {
        Eigen::Map<RowMajor<6, pose_size>>(jacobian).setIdentity();
        return true;
    }

  private:
    static constexpr int pose_size = blockSize(StateKind::Pose);
    template <int rows, int columns>
    using RowMajor = Eigen::Matrix<double, rows, columns, Eigen::RowMajor>;
};

}  // namespace rgbd_graphslam
