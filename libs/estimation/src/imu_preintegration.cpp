#include "rgbd_graphslam/estimation/imu_preintegration.h"

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "sample_window.h"

namespace rgbd_graphslam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ImuSample interpolated(const ImuSample& a, const ImuSample& b, double stamp_s) {
    const double share = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
    return {stamp_s, (1 - share) * a.gyro + share * b.gyro,
            (1 - share) * a.accelerometer + share * b.accelerometer};
}

Matrix3d rightJacobian(const Vector3d& phi) {
    return leftJacobian(-phi);
}

/** What a step does to errors of (position, rotation, velocity), and to them by errors of the
 *  readings. */
struct StepDerivatives {
    Matrix9d by_state = Matrix9d::Identity();
    Eigen::Matrix<double, 9, 6> by_reading = Eigen::Matrix<double, 9, 6>::Zero();
};

/** Readings are constant during the step; the acceleration is turned by the rotation at its middle.
 */
StepDerivatives advance(const Vector3d& rate, const Vector3d& acceleration, double dt,
                        ImuIncrement& increment) {
    const Vector3d turn = rate * dt;
    const Matrix3d half_turn = rotationExp(0.5 * turn),
                   R_middle = increment.T_from_to.R * half_turn;
    const Matrix3d by_middle = -R_middle * skew(acceleration);
    StepDerivatives d;
    d.by_state.block<3, 3>(3, 3) = rotationExp(-turn);
    d.by_reading.block<3, 3>(3, 0) = rightJacobian(turn) * dt;
    d.by_state.block<3, 3>(6, 3) = by_middle * half_turn.transpose() * dt;
    d.by_reading.block<3, 3>(6, 0) = by_middle * rightJacobian(0.5 * turn) * (0.5 * dt * dt);
    d.by_reading.block<3, 3>(6, 3) = R_middle * dt;
    d.by_state.block<3, 3>(0, 6) = Matrix3d::Identity() * dt;
    d.by_state.block<3, 3>(0, 3) = 0.5 * dt * d.by_state.block<3, 3>(6, 3);
    d.by_reading.topRows<3>() = 0.5 * dt * d.by_reading.bottomRows<3>();
    const Vector3d gained = R_middle * acceleration * dt;
    increment.T_from_to = {increment.T_from_to.R * rotationExp(turn),
                           increment.T_from_to.t + (increment.velocity + 0.5 * gained) * dt};
    increment.velocity += gained;
    increment.duration_s += dt;
    return d;
}

void addStep(const ImuSample& a, const ImuSample& b, const ImuNoise& noise,
             ImuIncrement& increment) {
    const double dt = b.stamp_s - a.stamp_s;
    if (dt <= 0) return;
    const Vector3d rate = 0.5 * (a.gyro + b.gyro) - increment.bias.gyro;
    const Vector3d acceleration =
        0.5 * (a.accelerometer + b.accelerometer) - increment.bias.accelerometer;
    const auto [F, G] = advance(rate, acceleration, dt, increment);
    Vector6d variance;
    variance << Vector3d::Constant(noise.gyro * noise.gyro / dt),
        Vector3d::Constant(noise.accelerometer * noise.accelerometer / dt);
    increment.covariance =
        F * increment.covariance * F.transpose() + G * variance.asDiagonal() * G.transpose();
    increment.by_bias = F * increment.by_bias - G;
}

}  // namespace

ImuIncrement ImuIncrement::corrected(const ImuBias& other) const {
    Vector6d change;
    change << other.gyro - bias.gyro, other.accelerometer - bias.accelerometer;
    const Eigen::Matrix<double, 9, 1> moved = by_bias * change;
    ImuIncrement result = *this;
    result.bias = other;
    result.T_from_to.t += moved.head<3>();
    result.T_from_to.R = T_from_to.R * rotationExp(moved.segment<3>(3));
    result.velocity += moved.tail<3>();
    return result;
}

std::optional<ImuIncrement> preintegrate(const std::vector<ImuSample>& samples, double from_s,
                                         double to_s, const ImuBias& bias, const ImuNoise& noise,
                                         double longest_gap_s) {
    const auto between = samplesBetween(samples, from_s, to_s, longest_gap_s, interpolated);
    if (!between) return std::nullopt;
    ImuIncrement increment;
    increment.bias = bias;
    for (std::size_t i = 1; i < between->size(); ++i) {
        addStep((*between)[i - 1], (*between)[i], noise, increment);
    }
    increment.T_from_to.R = orthonormalized(increment.T_from_to.R);
    return increment;
}

}  // namespace rgbd_graphslam
