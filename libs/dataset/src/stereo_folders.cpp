#include "stereo_folders.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::size_t filesIn(const fs::path& folder) {
    if (!fs::is_directory(folder)) return 0;
    const auto files = fs::directory_iterator(folder);
    return static_cast<std::size_t>(std::distance(fs::begin(files), fs::end(files)));
}

void refusePairs(const std::string& folder, const char* layout, const fs::path& left,
                 const fs::path& right) {
    const std::size_t pairs = std::min(filesIn(left), filesIn(right));
    if (pairs == 0) return;
    throw Error("'" + folder + "' is a stereo recording in the layout of " + layout +
                    ": recognized, " + std::to_string(pairs) + " pairs",
                "rgbd-slam cannot track stereo yet, give a recording with depth images");
}

}  // namespace

void refuseStereo(const std::string& folder) {
    const fs::path path(folder);
    for (const fs::path& root : {path / "mav0", path}) {
        refusePairs(folder, "EuRoC", root / "cam0" / "data", root / "cam1" / "data");
    }
    refusePairs(folder, "KITTI odometry", path / "image_0", path / "image_1");
    refusePairs(folder, "KITTI odometry", path / "image_2", path / "image_3");
    refusePairs(folder, "left/ and right/", path / "left", path / "right");
}

}  // namespace rgbd_graphslam
