#include "run_points.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {

PointMap readRunPoints(const std::string& run_folder, std::size_t most) {
    const auto path = std::filesystem::path(run_folder) / "points.ply";
    if (!std::filesystem::exists(path)) {
        throw Error("'" + run_folder + "' has no points.ply",
                    "make the maps with: rgbd-map " + run_folder);
    }
    PointMap points = loadPly(path.string());
    if (most == 0 || points.size() <= most) return points;
    PointMap thinned;
    thinned.reserve(most);
    for (std::size_t i = 0; i < most; ++i) thinned.push_back(points[i * points.size() / most]);
    return thinned;
}

}  // namespace rgbd_graphslam
