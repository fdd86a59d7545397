/** How cameras and robots move: smooth to the second derivative, so that an IMU can ride along. */
#pragma once
#include <functional>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam::synth {

/** Uniform cubic B-spline through space; passes near its control points, not through them. */
class Spline {
  public:
    /** \param closed returns to its start and goes round for ever; otherwise it stays at its ends
     *  \param step_s time between control points */
    Spline(std::vector<Eigen::Vector3d> controls, double step_s, bool closed);
    Eigen::Vector3d at(double t) const;
    Eigen::Vector3d velocity(double t) const;
    /** One round, or from end to end. */
    double duration() const;

  private:
    const Eigen::Vector3d& control(long index) const;
    std::vector<Eigen::Vector3d> controls_;
    double step_s_;
    bool closed_;
};

/** Points at equal distances along a polyline, for a spline of even speed.
 *  \param closed also from the last corner to the first */
std::vector<Eigen::Vector3d> evenlySpaced(const std::vector<Eigen::Vector3d>& corners,
                                          double spacing_m, bool closed);

/** The trembling of a hand: sums of sinusoids from 0.5 to 6 Hz. */
struct Tremble {
    double translation_m = 0.006;
    double rotation_rad = 0.009;
    /** Bobbing of a person's steps, 0 when standing. */
    double step_m = 0;
};

/** A camera's way. */
struct Motion {
    double duration_s = 0;
    std::function<SE3(double)> T_world_cam;
    /** Of a planar robot that carries the camera; empty when a hand does. */
    std::function<SE3(double)> T_world_base;
    /** Where the world is itself carried, as the cabin of a lift is: its pose in a frame that is
     *  not. Inertial sensors feel this motion, wheels do not. Empty: it is not carried. */
    std::function<SE3(double)> T_inertial_world;
};

/** A camera carried along `positions` that looks at a moving target.
 *  \throws Error when position and target meet */
Motion handHeld(const Spline& positions, const Spline& targets, const Tremble& tremble,
                std::uint64_t seed);

/** A robot with its camera 0.15 m ahead of its turning point, 0.6 m above the floor, looking
 *  ahead. \param way in the floor's plane; the robot looks along it */
Motion planarRobot(const Spline& way);

/** Camera on the planar robot, optical frame. */
SE3 robotCamera();

/** Camera at a point, looking at another with its x axis level. */
SE3 lookingAt(const Eigen::Vector3d& from, const Eigen::Vector3d& target);

/** MRPT's camera frame (x forward, y left, z up) seen from the optical one. */
Eigen::Matrix3d forwardToOptical();

}  // namespace rgbd_graphslam::synth
