/** Wheel odometry between two moments. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/motion_samples.h"

namespace rgbd_graphslam {

/** Variances that grow with the way. */
struct WheelNoise {
    double forward_m2_per_m = 1e-4;
    double sideways_m2_per_m = 1e-5;
    double yaw_rad2_per_m = 1e-5;
    double yaw_rad2_per_rad = 1e-3;
    /** What remains at rest, so that no increment claims to be exact. */
    double least_sigma_m = 1e-4, least_sigma_rad = 1e-4;
};

/** Motion of the robot's base in its plane. */
struct WheelIncrement {
    double duration_s = 0;
    PlanarPose T_from_to;
    /** Of (x, y, yaw) in the frame of the first moment. */
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/** Composes what the wheels measured from sample to sample and propagates its covariance (Thrun,
 *  Burgard and Fox, "Probabilistic Robotics", 2005, section 5.4). Poses are interpolated at both
 *  ends.
 *  \param samples by rising stamp, with at least one at or before `from_s` and one at or after
 *         `to_s`; others may surround them
 *  \param longest_gap_s between samples
 *  \return nothing where the samples do not reach both ends, repeat or go back in time, or leave a
 *          longer gap */
std::optional<WheelIncrement> preintegrate(const std::vector<WheelSample>& samples, double from_s,
                                           double to_s, const WheelNoise& noise,
                                           double longest_gap_s = 0.3);

}  // namespace rgbd_graphslam
