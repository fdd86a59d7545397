/** What a rawlog holds. */
#pragma once
#include <cstddef>
#include <string>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Counts of entries, and the first frame's calibration. */
struct RawlogInfo {
    std::size_t rgbd_frames = 0, imu = 0, odometry = 0, robot_poses = 0, others = 0;
    /** UNIX time of the first and last RGB-D frame in file order; 0 without frames. */
    double first_stamp_s = 0, last_stamp_s = 0;
    /** Of the first frame: calibration, depth unit, pose of the camera's optical frame on the
     *  robot, and whether depth is registered to color. */
    Intrinsics camera;
    double depth_unit_m = 0;
    SE3 T_base_cam;
    bool depth_is_registered = true;
    /** Empty when the file is whole, else where and how it is cut off or damaged; the counts then
     *  speak of what comes before. */
    std::string damage;
};

/** Reads the whole rawlog once; pixels stored in the rawlog are read but not decoded.
 *  \throws Error when it is missing or not a rawlog */
RawlogInfo inspectRawlog(const std::string& path);

/** Ground truth in a rawlog, as poses of the color camera's optical frame in the truth's world.
 *  \return empty when there is none
 *  \throws Error as RawlogReader does */
Trajectory truthOf(const std::string& rawlog_path);

}  // namespace rgbd_graphslam
