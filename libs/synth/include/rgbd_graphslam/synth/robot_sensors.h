/** Inertial sensors and wheel odometry that ride along a motion. */
#pragma once
#include <functional>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/synth/motion.h"
#include "rgbd_graphslam/synth/random.h"

namespace rgbd_graphslam::synth {

/** One reading of accelerometer and gyroscope, free of noise. */
struct InertialReading {
    Eigen::Vector3d specific_force;  // m/s^2, optical frame: 9.81 against gravity when at rest
    Eigen::Vector3d angular_rate;    // rad/s, optical frame
};

/** Biases and white noise of a cheap MEMS unit at 200 Hz, and what else goes wrong with one. */
struct InertialModel {
    double force_bias = 0.05, force_noise = 0.04;  // m/s^2
    double rate_bias = 0.004, rate_noise = 0.002;  // rad/s
    /** Random walk of the biases, per square root of a second. */
    double force_walk = 0, rate_walk = 0;
    /** Change of the biases as the unit warms up, from `warms_at_s` on, and how fast. */
    double force_warming = 0, rate_warming = 0;
    double warms_at_s = 5, warming_s = 3;
    /** Larger components of a reading are cut off; 0 = none are. */
    double largest_force = 0, largest_rate = 0;
    /** Stamps are later than the readings by this. */
    double time_offset_s = 0;
};

/** True reading at time t, by differences of the motion over 2 ms. */
InertialReading trueInertial(const Motion& motion, double t);

/** An inertial unit: its biases begin as drawn from the seed. */
class InertialUnit {
  public:
    InertialUnit(const Motion& motion, const InertialModel& model, std::uint64_t seed);
    /** \param t its stamp
     *  \param index of the reading, which its noise depends on; rises by one, or begins again */
    InertialReading read(double t, std::uint64_t index);

    /** Error of the last reading but for noise: force (m/s^2), then rate (rad/s). */
    const Vector6d& bias() const { return bias_; }

  private:
    void walk(double t, std::uint64_t index);

    const Motion& motion_;
    InertialModel model_;
    std::uint64_t seed_;
    Vector6d first_bias_, warming_, walked_ = Vector6d::Zero(), bias_;
    double last_t_ = 0;
};

/** Errors of a differential drive's odometry. */
struct WheelModel {
    double scale_error = 0.01;        // of distance
    double turn_scale_error = 0.015;  // of angle
    double distance_noise = 0.02;     // deviation over a distance d: this * sqrt(d * 1 m)
    double turn_noise = 0.01;         // rad, the same way per sqrt(m)
    double slip_chance = 0.01;        // of a step in which the wheels spin
    double radius_error = 0;          // the wheels are larger than their driver knows, a share
};

/** A time during which the wheels do not hold the floor. */
struct SlipEpisode {
    double from_s = 0, to_s = 0;
    /** What the wheels turn per true way: 2 where they spin, 0 where they are locked. */
    double way_factor = 1;
    /** That the wheels tell beyond the true turn, rad/s. */
    double turn_rad_s = 0;
};

/** Dead reckoning from wheel increments; starts at the true pose of its first reading. */
class Odometer {
  public:
    Odometer(const Motion& motion, const WheelModel& model, std::uint64_t seed,
             std::vector<SlipEpisode> slips = {});
    /** Advances to time t. \return x (m), y (m), heading (rad) in the odometry's frame */
    Eigen::Vector3d advance(double t);

  private:
    const Motion& motion_;
    WheelModel model_;
    Random random_;
    const std::vector<SlipEpisode> slips_;
    double scale_, turn_scale_;
    double last_t_ = 0;
    bool started_ = false;
    SE3 last_true_;
    Eigen::Vector3d estimate_{0, 0, 0};
};

}  // namespace rgbd_graphslam::synth
