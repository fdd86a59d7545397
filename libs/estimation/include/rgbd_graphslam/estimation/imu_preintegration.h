/** Many inertial readings as one measurement of the motion between two moments. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/motion_samples.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

/** Constant errors of both sensors. */
struct ImuBias {
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();           // rad/s
    Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();  // m/s^2
};

/** Densities of white noise and of the biases' random walk. */
struct ImuNoise {
    double gyro = 1e-3;                // rad/s/sqrt(Hz)
    double accelerometer = 1e-2;       // m/s^2/sqrt(Hz)
    double gyro_walk = 1e-5;           // rad/s^2/sqrt(Hz)
    double accelerometer_walk = 1e-4;  // m/s^3/sqrt(Hz)
};

/** Motion of the sensor between two moments, in its frame at the first and without gravity and
 *  initial velocity. */
struct ImuIncrement {
    double duration_s = 0;
    SE3 T_from_to;                                       // rotation, and m
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
    /** Of (position, rotation, velocity), the rotation perturbed on the right (rad). */
    Matrix9d covariance = Matrix9d::Zero();
    /** The biases that were subtracted, and the derivative of (position, rotation, velocity) by
     *  (gyro bias, accelerometer bias). */
    ImuBias bias;
    Eigen::Matrix<double, 9, 6> by_bias = Eigen::Matrix<double, 9, 6>::Zero();

    /** What integrating again with other biases would give, to first order; the covariance and the
     *  derivative stay as they are. */
    ImuIncrement corrected(const ImuBias& other) const;
};

/** Preintegrates on the manifold (Forster et al., "On-manifold preintegration for real-time
 *  visual-inertial odometry", T-RO 2017), with readings taken to be linear in between. Readings are
 *  interpolated at both ends, which are seldom their own stamps.
 *  \param samples by rising stamp, with at least one at or before `from_s` and one at or after
 *         `to_s`; others may surround them
 *  \param longest_gap_s between samples
 *  \return nothing where the samples do not reach both ends, repeat or go back in time, or leave a
 *          longer gap: what happened in it is not known */
std::optional<ImuIncrement> preintegrate(const std::vector<ImuSample>& samples, double from_s,
                                         double to_s, const ImuBias& bias, const ImuNoise& noise,
                                         double longest_gap_s = 0.05);

}  // namespace rgbd_graphslam
