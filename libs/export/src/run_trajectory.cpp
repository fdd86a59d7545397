#include "run_trajectory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

Trajectory readRunTrajectory(const std::string& run_folder) {
    const auto path = std::filesystem::path(run_folder) / "trajectory.txt";
    if (!std::filesystem::exists(path)) {
        throw Error("'" + run_folder + "' has no trajectory.txt",
                    "give the output folder of a finished rgbd-slam run");
    }
    return readTumTrajectory(path.string());
}

std::size_t framesWithoutPose(const std::string& run_folder, const Trajectory& trajectory) {
    std::ifstream in(std::filesystem::path(run_folder) / "frames.csv");
    const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
    const auto frames = lines > 0 ? static_cast<std::size_t>(lines - 1) : 0;
    return frames > trajectory.size() ? frames - trajectory.size() : 0;
}

std::string poseCount(const Trajectory& trajectory) {
    return std::to_string(trajectory.size()) + " poses";
}

}  // namespace rgbd_graphslam
