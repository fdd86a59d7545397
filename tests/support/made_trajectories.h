/** Trajectories whose errors are known. */
#pragma once
#include <cmath>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** A rising circle of radius 1 m in ten seconds that looks along its tangent. */
inline Trajectory circle(int poses = 101, double first_stamp_s = 100) {
    Trajectory path;
    for (int k = 0; k < poses; ++k) {
        const double angle = 2 * M_PI * k / (poses - 1);
        path.push_back({first_stamp_s + 10.0 * k / (poses - 1),
                        SE3(rotationExp({0, 0, angle}),
                            {std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle)})});
    }
    return path;
}

/** Along x at a constant speed while turning about z, a pose every 0.1 s. */
inline Trajectory straight(double speed_m_s, double turn_rad_s, int poses = 101) {
    Trajectory path;
    for (int k = 0; k < poses; ++k) {
        const double t = k / 10.0;
        path.push_back({t, SE3(rotationExp({0, 0, turn_rad_s * t}), {speed_m_s * t, 0, 0})});
    }
    return path;
}

inline SE3 someMotion() {
    return {rotationExp({0.3, -1.1, 0.7}), {4, -5, 6}};
}

inline Trajectory moved(Trajectory path, const SE3& motion) {
    for (auto& pose : path) pose.T_world_cam = motion * pose.T_world_cam;
    return path;
}

inline Trajectory scaled(Trajectory path, double scale) {
    for (auto& pose : path) pose.T_world_cam.t *= scale;
    return path;
}

inline Trajectory delayed(Trajectory path, double seconds) {
    for (auto& pose : path) pose.stamp_s += seconds;
    return path;
}

}  // namespace rgbd_graphslam
