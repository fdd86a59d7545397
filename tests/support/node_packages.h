/** npm packages for tests whose files are written or read by other people's programs. */
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

namespace rgbd_graphslam {

/** Folder whose node_modules has the packages for ROS 2 bags (tests/support/ros2/package.json),
 * which the build installs. \return empty where node, npm or the network is missing */
inline std::string nodePackages() {
    const std::string folder = RGBD_BINARY_DIR "/ros2_bags";
    const bool installed = std::filesystem::exists(folder + "/node_modules/@mcap/core");
    return installed && std::system("node --version >/dev/null 2>&1") == 0 ? folder : "";
}

}  // namespace rgbd_graphslam
