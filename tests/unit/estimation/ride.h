/** A smooth ride whose inertial readings are known. */
#pragma once
#include <cmath>
#include <vector>

#include "rgbd_graphslam/estimation/imu_preintegration.h"
#include "rgbd_graphslam/estimation/states.h"

namespace rgbd_graphslam {

/** Up and down and round a room of a few meters, turning about all axes. */
struct Ride {
    Eigen::Vector3d gravity{0, 0, -9.81};
    MotionState bias;  // and no velocity

    SE3 T_world_imu(double s) const {
        const Eigen::Matrix3d R = rotationExp({0, 0, 0.9 * s}) *
                                  rotationExp({0, 0.5 * std::sin(1.3 * s), 0}) *
                                  rotationExp({0.4 * std::cos(1.7 * s), 0, 0});
        return {R, {std::cos(0.8 * s), 1.5 * std::sin(0.6 * s), 0.3 * std::sin(1.9 * s)}};
    }
    Eigen::Vector3d velocity(double s) const {
        return {-0.8 * std::sin(0.8 * s), 0.9 * std::cos(0.6 * s), 0.57 * std::cos(1.9 * s)};
    }
    ImuSample sample(double s) const {
        constexpr double h = 1e-4;
        const Eigen::Matrix3d R = T_world_imu(s).R;
        const Eigen::Matrix3d turn = T_world_imu(s - h).R.transpose() * T_world_imu(s + h).R;
        const Eigen::Vector3d acceleration = (velocity(s + h) - velocity(s - h)) / (2 * h);
        return {s, rotationLog(turn) / (2 * h) + bias.gyro_bias,
                R.transpose() * (acceleration - gravity) + bias.accelerometer_bias};
    }
    /** Readings from before one moment until after another. */
    std::vector<ImuSample> samples(double from_s, double to_s, double rate_hz = 400) const {
        std::vector<ImuSample> all;
        for (int i = 0; i <= static_cast<int>((to_s - from_s) * rate_hz) + 2; ++i) {
            all.push_back(sample(from_s + (i - 0.7) / rate_hz));
        }
        return all;
    }
    /** \param T_imu_body place of the body's frame */
    KeyframeState state(double s, const SE3& T_imu_body = {}) const {
        KeyframeState state{(T_world_imu(s) * T_imu_body).inverse(), bias};
        state.motion.velocity = velocity(s);
        return state;
    }
};

}  // namespace rgbd_graphslam
