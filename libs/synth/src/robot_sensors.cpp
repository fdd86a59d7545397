#include "rgbd_graphslam/synth/robot_sensors.h"

#include <cmath>

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
    force_bias_ = model.force_bias * normalVector(random);
    rate_bias_ = model.rate_bias * normalVector(random);
}

InertialReading InertialUnit::read(double t, std::uint64_t index) const {
    Random random = Random::of(seed_, 4, index);
    InertialReading reading = trueInertial(motion_, t);
    reading.specific_force += force_bias_ + model_.force_noise * normalVector(random);
    reading.angular_rate += rate_bias_ + model_.rate_noise * normalVector(random);
    return reading;
}

Odometer::Odometer(const Motion& motion, const WheelModel& model, std::uint64_t seed)
    : motion_(motion), model_(model), random_(Random::of(seed, 5)) {
    scale_ = 1 + model.scale_error * random_.normal();
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
        const double wheels =
            distance * scale_ * spin + model_.distance_noise * spread * random_.normal();
        const double turn =
            heading(moved) * turn_scale_ + model_.turn_noise * spread * random_.normal();
        estimate_.x() += wheels * std::cos(estimate_.z() + turn / 2);
        estimate_.y() += wheels * std::sin(estimate_.z() + turn / 2);
        estimate_.z() = std::remainder(estimate_.z() + turn, 2 * std::acos(-1.0));
    }
    last_true_ = now;
    return estimate_;
}

}  // namespace rgbd_graphslam::synth
