#include "rgbd_graphslam/estimation/wheel_preintegration.h"

#include <Eigen/Geometry>
#include <cmath>

#include "sample_window.h"

namespace rgbd_graphslam {
namespace {

double wrapped(double angle) {
    return std::remainder(angle, 2 * M_PI);
}

WheelSample interpolated(const WheelSample& a, const WheelSample& b, double stamp_s) {
    const double share = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
    const PlanarPose &from = a.T_start_base, &to = b.T_start_base;
    return {stamp_s,
            {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
             wrapped(from.yaw + share * wrapped(to.yaw - from.yaw))}};
}

/** Variances of a short motion in its own frame. */
Eigen::Vector3d varianceOf(const PlanarPose& motion, const WheelNoise& noise) {
    const double way = std::hypot(motion.x, motion.y);
    return {noise.forward_m2_per_m * way, noise.sideways_m2_per_m * way,
            noise.yaw_rad2_per_m * way + noise.yaw_rad2_per_rad * std::abs(motion.yaw)};
}

void addStep(const PlanarPose& motion, const WheelNoise& noise, WheelIncrement& increment) {
    const PlanarPose moved = increment.T_from_to * motion;
    Eigen::Matrix3d by_state = Eigen::Matrix3d::Identity(), by_motion = by_state;
    by_state(0, 2) = -(moved.y - increment.T_from_to.y);
    by_state(1, 2) = moved.x - increment.T_from_to.x;
    by_motion.topLeftCorner<2, 2>() =
        Eigen::Rotation2Dd(increment.T_from_to.yaw).toRotationMatrix();
    increment.covariance =
        by_state * increment.covariance * by_state.transpose() +
        by_motion * varianceOf(motion, noise).asDiagonal() * by_motion.transpose();
    increment.T_from_to = moved;
}

}  // namespace

std::optional<WheelIncrement> preintegrate(const std::vector<WheelSample>& samples, double from_s,
                                           double to_s, const WheelNoise& noise,
                                           double longest_gap_s) {
    const auto between = samplesBetween(samples, from_s, to_s, longest_gap_s, interpolated);
    if (!between) return std::nullopt;
    WheelIncrement increment;
    increment.duration_s = to_s - from_s;
    for (std::size_t i = 1; i < between->size(); ++i) {
        addStep((*between)[i - 1].T_start_base.inverse() * (*between)[i].T_start_base, noise,
                increment);
    }
    increment.covariance.diagonal() +=
        Eigen::Vector3d(noise.least_sigma_m, noise.least_sigma_m, noise.least_sigma_rad)
            .cwiseAbs2();
    return increment;
}

}  // namespace rgbd_graphslam
