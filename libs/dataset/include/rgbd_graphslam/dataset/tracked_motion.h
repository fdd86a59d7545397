/** How a sensor on the camera's body moved, by what the camera saw. */
#pragma once
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Poses without a break; a new one begins where tracking was lost or the map is another. */
using TrackedStretches = std::vector<Trajectory>;

/** Of a trajectory, broken where two poses are further apart in time. */
TrackedStretches stretchesOf(const Trajectory& trajectory, double longest_gap_s = 0.5);

/** The same path of another frame that moves along: poses T_world_cam * T_cam_other. */
TrackedStretches movedAlong(const TrackedStretches& camera, const SE3& T_cam_other);

}  // namespace rgbd_graphslam
