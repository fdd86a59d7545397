/** Small ROS bags of every kind, written without ROS. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

std::vector<std::string> ros1BagSeeds();
std::vector<std::string> mcapSeeds();
std::vector<std::string> ros2DatabaseSeeds();
/** Behind a byte that tells the wire format, see fuzzRosMessages(). */
std::vector<std::string> rosMessageSeeds();
/** Behind a byte that tells the format, see fuzzCompressedDepth(). */
std::vector<std::string> compressedDepthSeeds();

}  // namespace rgbd_graphslam
