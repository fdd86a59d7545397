/** Camera work that several scenarios share. */
#pragma once
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

/** A camera's automatic exposure hunts slowly by some per cent. */
Exposure drifting(double t);
/** The same in little light: noisy and blurred by a long exposure. */
Exposure dim(double t, double brightness);

/** Eye and gaze on ellipses about a point, the gaze ahead of the eye; one round. */
Motion strollAround(const Eigen::Vector3d& center, double radius_x, double radius_y, double seconds,
                    double ahead_rad, std::uint64_t seed);

/** Hand-held, swaying about a place, its gaze about a target. One round takes 15 s.
 *  \param sway half the size of both ways (m) */
Motion watchFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                 const Eigen::Vector3d& eye_sway, const Eigen::Vector3d& target_sway,
                 std::uint64_t seed);

/** 0 before `begin`, 1 after `end`, smooth between. */
double easing(double t, double begin, double end);

}  // namespace rgbd_graphslam::synth
