/** The unknowns of an estimation problem. */
#pragma once
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Vector15d = Eigen::Matrix<double, 15, 1>;

/** What an inertial sensor adds to a pose. Its tangent vector is (velocity, gyro bias,
 *  accelerometer bias). */
struct MotionState {
    /** Of the inertial sensor, in the world, m/s. */
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();           // rad/s
    Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  // m/s^2

    MotionState retract(const Vector9d& delta) const;
    /** Tangent vector with other.retract(...) == *this. */
    Vector9d minus(const MotionState& other) const;
};

/** A keyframe's state: 6 unknowns when only poses are estimated, 15 with an inertial sensor.
 *
 *  The body is the robot's base, or the first camera where there is no robot. The pose is stored as
 *  T_body_world because that is what predicts a measurement: no observation of a point has to
 *  invert it, and its left perturbation (see SE3) is a motion in the body's own frame, as in the
 *  literature on preintegration (which writes it as a right perturbation of T_world_body, with the
 *  opposite sign). */
struct KeyframeState {
    SE3 T_body_world;
    MotionState motion;

    /** Perturbs the pose alone by 6 numbers. */
    KeyframeState retract(const Vector6d& delta) const;
    /** Perturbs pose (first 6 numbers) and motion. */
    KeyframeState retract(const Vector15d& delta) const;
    /** Tangent vector with other.retract(...) == *this. */
    Vector15d minus(const KeyframeState& other) const;
};

/** All unknowns of a problem. */
struct States {
    std::vector<KeyframeState> keyframes;
    std::vector<Eigen::Vector3d> points;  // world, m
};

}  // namespace rgbd_graphslam
