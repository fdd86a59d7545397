/** Inertial sensors and wheel odometry that ride along a motion. */
#pragma once
#include <functional>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/synth/motion.h"
#include "rgbd_graphslam/synth/random.h"

namespace rgbd_graphslam::synth {

/** One reading of accelerometer and gyroscope, free of noise. */
struct InertialReading {
    Eigen::Vector3d specific_force;  // m/s^2, optical frame: 9.81 against gravity when at rest
    Eigen::Vector3d angular_rate;    // rad/s, optical frame
};

/** Biases (constant) and white noise of a cheap MEMS unit at 200 Hz. */
struct InertialModel {
    double force_bias = 0.05, force_noise = 0.04;  // m/s^2
    double rate_bias = 0.004, rate_noise = 0.002;  // rad/s
};

/** True reading at time t, by differences of the motion over 2 ms. */
InertialReading trueInertial(const Motion& motion, double t);

/** An inertial unit: biases are drawn from the seed once. */
class InertialUnit {
  public:
    InertialUnit(const Motion& motion, const InertialModel& model, std::uint64_t seed);
    /** \param index of the reading, which its noise depends on */
    InertialReading read(double t, std::uint64_t index) const;

  private:
    const Motion& motion_;
    InertialModel model_;
    std::uint64_t seed_;
    Eigen::Vector3d force_bias_, rate_bias_;
};

/** Errors of a differential drive's odometry. */
struct WheelModel {
    double scale_error = 0.01;        // of distance
    double turn_scale_error = 0.015;  // of angle
    double distance_noise = 0.02;     // deviation over a distance d: this * sqrt(d * 1 m)
    double turn_noise = 0.01;         // rad, the same way per sqrt(m)
    double slip_chance = 0.01;        // of a step in which the wheels spin
};

/** Dead reckoning from wheel increments; starts at the true pose of its first reading. */
class Odometer {
  public:
    Odometer(const Motion& motion, const WheelModel& model, std::uint64_t seed);
    /** Advances to time t. \return x (m), y (m), heading (rad) in the odometry's frame */
    Eigen::Vector3d advance(double t);

  private:
    const Motion& motion_;
    WheelModel model_;
    Random random_;
    double scale_, turn_scale_;
    bool started_ = false;
    SE3 last_true_;
    Eigen::Vector3d estimate_{0, 0, 0};
};

}  // namespace rgbd_graphslam::synth
