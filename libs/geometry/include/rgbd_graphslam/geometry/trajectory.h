/** Poses over time. */
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A pose at a point in time (UNIX time, s). */
struct StampedPose {
    double stamp_s = 0;
    SE3 T_world_cam;
};

/** In order of time. */
using Trajectory = std::vector<StampedPose>;

/** The pose at a time, interpolated between the poses around it. Nothing before the first and after
 *  the last, and between two that are further apart in time than longest_gap_s. */
std::optional<SE3> poseAt(const Trajectory& trajectory, double stamp_s,
                          double longest_gap_s = std::numeric_limits<double>::infinity());

/** Whether one of the stamps lies between two moments, both of them left out. A path is not drawn
 *  across a frame without a pose: nobody saw how the camera went.
 *  \param stamps_s rising */
bool anyBetween(const std::vector<double>& stamps_s, double from_s, double to_s);

/** Consecutive pieces of these lengths, shorter where poses run out, and the rest as the last one.
 */
std::vector<Trajectory> pieces(const Trajectory& poses, const std::vector<std::size_t>& lengths);

/** Reads `stamp tx ty tz qx qy qz qw` lines (seconds, meters, unit quaternion), the format of the
 *  TUM RGB-D benchmark; commas and tabs separate as blanks do, `#` starts a comment. Rows with NaN
 *  are left out as TUM's tools do.
 *  \throws Error naming file and line for anything else, or when no pose is left */
Trajectory readTumTrajectory(const std::string& path);

/** The same poses in the order of their lines. */
Trajectory readTumPoses(const std::string& path);

/** The text of readTumTrajectory's format: stamps to the microsecond, meters and quaternions to
 *  nine decimals. */
std::string toTumText(const Trajectory& trajectory);

}  // namespace rgbd_graphslam
