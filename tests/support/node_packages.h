/** Packages of npm for tests that have files read or written by other people's programs. */
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

namespace rgbd_graphslam {

/** Folder with node_modules that has the packages for ROS 2 bags: @mcap/core, @foxglove/rosmsg and
 *  @foxglove/rosmsg2-serialization. Installed into the build folder on first use; to be called from
 *  one executable at a time.
 *  \return empty where node, npm or the network is missing */
inline std::string nodePackages() {
    namespace fs = std::filesystem;
    const std::string folder = RGBD_BINARY_DIR "/npm";
    if (std::system("node --version >/dev/null 2>&1") != 0) return "";
    if (fs::exists(folder + "/complete")) return folder;
    fs::create_directories(folder);
    const std::string install = "cd '" + folder +
                                "' && npm install --no-audit --no-fund --silent @mcap/core@2 "
                                "@foxglove/rosmsg@5 @foxglove/rosmsg2-serialization@3 "
                                ">install.log 2>&1 && touch complete";
    return std::system(install.c_str()) == 0 ? folder : "";
}

}  // namespace rgbd_graphslam
