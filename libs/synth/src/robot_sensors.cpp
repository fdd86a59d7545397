#include "rgbd_graphslam/synth/robot_sensors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

Vector3d normalVector(Random& random) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return {x, y, z};
}

SE3 inertialPose(const Motion& motion, double t) {
    const SE3 pose = motion.T_world_cam(t);
    return motion.T_inertial_world ? motion.T_inertial_world(t) * pose : pose;
}

double heading(const SE3& pose) {
    return std::atan2(pose.R(1, 0), pose.R(0, 0));
}
}  // namespace

InertialReading trueInertial(const Motion& motion, double t) {
    const double step = 2e-3;
    const SE3 before = inertialPose(motion, t - step), now = inertialPose(motion, t),
              after = inertialPose(motion, t + step);
    const Vector3d acceleration = (after.t - 2 * now.t + before.t) / (step * step);
    const Vector3d gravity(0, 0, -9.81);
    return {now.R.transpose() * (acceleration - gravity),
            rotationLog(before.R.transpose() * after.R) / (2 * step)};
}

InertialUnit::InertialUnit(const Motion& motion, const InertialModel& model, std::uint64_t seed)
    : motion_(motion), model_(model), seed_(seed) {
    Random random = Random::of(seed, 3);
    first_bias_.head<3>() = model.force_bias * normalVector(random);
    first_bias_.tail<3>() = model.rate_bias * normalVector(random);
    Random warmth = Random::of(seed, 6);
    warming_.head<3>() = model.force_warming * normalVector(warmth).normalized();
    warming_.tail<3>() = model.rate_warming * normalVector(warmth).normalized();
    bias_ = first_bias_;
}

void InertialUnit::walk(double t, std::uint64_t index) {
    Random random = Random::of(seed_, 7, index);
    const double root = std::sqrt(std::max(0.0, t - last_t_));
    if (index == 0) {
        walked_.setZero();
    } else {
        walked_.head<3>() += model_.force_walk * root * normalVector(random);
        walked_.tail<3>() += model_.rate_walk * root * normalVector(random);
    }
    last_t_ = t;
    const double warm_s = std::max(0.0, t - model_.warms_at_s);
    bias_ = first_bias_ + walked_ + (1 - std::exp(-warm_s / model_.warming_s)) * warming_;
}

InertialReading InertialUnit::read(double t, std::uint64_t index) {
    walk(t, index);
    Random random = Random::of(seed_, 4, index);
    InertialReading reading = trueInertial(motion_, t - model_.time_offset_s);
    reading.specific_force += bias_.head<3>() + model_.force_noise * normalVector(random);
    reading.angular_rate += bias_.tail<3>() + model_.rate_noise * normalVector(random);
    const auto saturate = [](double most, Vector3d& value) {
        if (most > 0) value = value.cwiseMax(-most).cwiseMin(most);
    };
    saturate(model_.largest_force, reading.specific_force);
    saturate(model_.largest_rate, reading.angular_rate);
    return reading;
}

Odometer::Odometer(const Motion& motion, const WheelModel& model, std::uint64_t seed,
                   std::vector<SlipEpisode> slips)
    : motion_(motion), model_(model), random_(Random::of(seed, 5)), slips_(std::move(slips)) {
    scale_ = 1 + model.scale_error * random_.normal() - model.radius_error;
    turn_scale_ = 1 + model.turn_scale_error * random_.normal();
}

Vector3d Odometer::advance(double t) {
    const SE3 now = motion_.T_world_base(t);
    if (!started_) {
        started_ = true;
        estimate_ = {now.t.x(), now.t.y(), heading(now)};
    } else {
        const SE3 moved = last_true_.inverse() * now;
        const double distance = moved.t.x();
        const double spread = std::sqrt(std::abs(distance));
        const double spin = random_.chance(model_.slip_chance) ? random_.uniform(1.2, 2) : 1;
        double wheels =
            distance * scale_ * spin + model_.distance_noise * spread * random_.normal();
        double turn = heading(moved) * turn_scale_ + model_.turn_noise * spread * random_.normal();
        for (const SlipEpisode& slip : slips_) {
            const double share =
                std::clamp((std::min(t, slip.to_s) - std::max(last_t_, slip.from_s)) /
                               std::max(1e-9, t - last_t_),
                           0.0, 1.0);
            wheels += share * (slip.way_factor - 1) * distance;
            turn += share * slip.turn_rad_s * (t - last_t_);
        }
        estimate_.x() += wheels * std::cos(estimate_.z() + turn / 2);
        estimate_.y() += wheels * std::sin(estimate_.z() + turn / 2);
        estimate_.z() = std::remainder(estimate_.z() + turn, 2 * std::acos(-1.0));
    }
    last_true_ = now;
    last_t_ = t;
    return estimate_;
}

}  // namespace rgbd_graphslam::synth
