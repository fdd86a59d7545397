/** Wheel odometry between two keyframes, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"
#include "rgbd_graphslam/estimation/wheel_preintegration.h"

namespace rgbd_graphslam {

/** Constrains the motion of the robot's base in the plane that the base is in at the first
 *  keyframe. The residual is (x, y, yaw), m and rad; height, roll and pitch are free, since wheels
 *  do not measure them. */
class WheelFactor final : public Factor {
  public:
    /** \param T_base_body from the body's frame to that of the wheels (x forward, z up)
     *  \param kernel for wheels that slip
     *  \throws Error when the increment's covariance is not positive definite */
    WheelFactor(int from, int to, const WheelIncrement& increment, const SE3& T_base_body = {},
                const RobustKernel& kernel = {});

    std::vector<StateKey> states() const override { return {poseKey(from_), poseKey(to_)}; }
    int residualSize() const override { return 3; }
    RobustKernel kernel() const override { return kernel_; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int from_, to_;
    PlanarPose measured_;
    SE3 T_base_body_;
    Eigen::Matrix3d whitening_;
    RobustKernel kernel_;
};

}  // namespace rgbd_graphslam
