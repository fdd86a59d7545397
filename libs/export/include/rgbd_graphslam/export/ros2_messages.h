/** What a run has to say, as messages of ROS 2. */
#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** A message type and its definition. */
struct Ros2Type {
    std::string name;        // "nav_msgs/msg/Path"
    std::string definition;  // with those of all types it uses, as rosbag2 stores it
};

/** \param name one of tf2_msgs/msg/TFMessage, geometry_msgs/msg/PoseStamped, nav_msgs/msg/Path,
 *         sensor_msgs/msg/PointCloud2, nav_msgs/msg/OccupancyGrid */
Ros2Type ros2Type(const std::string& name);

/** Stamps as ROS counts them; those before 1970 become 0. */
std::int64_t rosNanoseconds(double stamp_s);

/** All of the following are CDR; poses and points are in the frame `frame`. */
std::string tfMessage(const StampedPose& pose, const std::string& frame, const std::string& child);
std::string poseMessage(const StampedPose& pose, const std::string& frame);
std::string pathMessage(const Trajectory& poses, const std::string& frame);
/** Fields x, y, z (float, m) and rgb as PCL packs it. */
std::string pointCloudMessage(const PointMap& points, double stamp_s, const std::string& frame);

/** An occupancy grid as `nav_msgs/OccupancyGrid` holds it. */
struct GridMap {
    cv::Mat1b cells;  // occupancy 0 to 100, 255 = unknown; the first row has the smallest y
    double cell_m = 0.05;
    double x_m = 0, y_m = 0;  // of the lower left corner
};
std::string gridMessage(const GridMap& grid, double stamp_s, const std::string& frame);

}  // namespace rgbd_graphslam
