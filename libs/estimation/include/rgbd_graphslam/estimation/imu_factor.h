/** A preintegrated inertial measurement between two keyframes, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"
#include "rgbd_graphslam/estimation/imu_preintegration.h"

namespace rgbd_graphslam {

/** Constrains poses, velocities and biases of both keyframes (Forster et al., T-RO 2017, eq. 45).
 *  The residual, in the sensor's frame at the first keyframe: position (m), rotation (rad),
 *  velocity (m/s), and the change of the gyro's and the accelerometer's bias. The velocity state is
 *  that of the sensor. */
class ImuFactor final : public Factor {
  public:
    /** \param gravity in the world, m/s^2; (0, 0, -9.81) where z points up
     *  \param T_imu_body from the body's frame to the sensor's
     *  \param noise the increment was made with
     *  \throws Error when the increment's covariance is not positive definite */
    ImuFactor(int from, int to, const ImuIncrement& increment, const Eigen::Vector3d& gravity,
              const ImuNoise& noise, const SE3& T_imu_body = {});

    /** Makes gravity an unknown: it is the vector `States::points[point]`, m/s^2. */
    void estimateGravity(int point) { gravity_point_ = point; }

    std::vector<StateKey> states() const override;
    int residualSize() const override { return 15; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int from_, to_;
    ImuIncrement increment_;
    Eigen::Vector3d gravity_;
    std::optional<int> gravity_point_;
    SE3 T_imu_body_;
    Eigen::Matrix<double, 15, 15> whitening_ = Eigen::Matrix<double, 15, 15>::Zero();
};

}  // namespace rgbd_graphslam
