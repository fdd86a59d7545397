/** Floor plans as ROS's map_server reads them. */
#pragma once
#include "rgbd_graphslam/export/ros2_messages.h"

namespace rgbd_graphslam {

/** grid.png and grid.yaml of a run, in map_server's trinary mode.
 *  \throws Error naming the file that is damaged */
GridMap readRosGrid(const std::string& stem);

}  // namespace rgbd_graphslam
