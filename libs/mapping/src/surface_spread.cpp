#include "rgbd_graphslam/mapping/surface_spread.h"

#include <array>
#include <cmath>
#include <map>

#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

constexpr double cell_m = 0.25;
constexpr double same_surface_cos = 0.94;  // 20 degrees
constexpr std::size_t fewest_patches = 3;  // of a keyframe in a cell

/** Cell, and which way the surface there faces: the two sides of a board are two surfaces. */
using Place = std::array<int, 4>;

struct PatchOfKeyframe {
    std::size_t keyframe;
    const SurfacePatch* patch;
};

/** 1 to 3 for the axis that the normal is nearest to, negative where it points backwards. */
int facing(const Eigen::Vector3d& normal) {
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    return normal[axis] < 0 ? -1 - axis : 1 + axis;
}

Place placeOf(const SurfacePatch& patch) {
    const Eigen::Vector3d cell = (patch.position / cell_m).array().floor();
    return {int(cell.x()), int(cell.y()), int(cell.z()), facing(patch.normal)};
}

/** Mean place of each keyframe's patches on the surface that most of the cell show. */
std::vector<Eigen::Vector3d> meansOf(const std::vector<PatchOfKeyframe>& cell,
                                     const Eigen::Vector3d& normal) {
    std::map<std::size_t, std::pair<Eigen::Vector3d, std::size_t>> sums;
    for (const auto& [keyframe, patch] : cell) {
        if (patch->normal.dot(normal) < same_surface_cos) continue;
        auto [entry, fresh] = sums.try_emplace(keyframe, Eigen::Vector3d::Zero(), 0);
        entry->second.first += patch->position;
        ++entry->second.second;
    }
    std::vector<Eigen::Vector3d> means;
    for (const auto& [keyframe, sum] : sums) {
        if (sum.second >= fewest_patches) means.emplace_back(sum.first / double(sum.second));
    }
    return means;
}

/** Appends the distances of a cell's keyframes from their common plane. */
void addDistances(const std::vector<PatchOfKeyframe>& cell, std::vector<double>& distances_m) {
    if (cell.size() < 2 * fewest_patches) return;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = normal;
    for (const auto& entry : cell) normal += entry.patch->normal;
    normal.normalize();
    const auto means = meansOf(cell, normal);
    if (means.size() < 2) return;
    for (const auto& mean : means) middle += mean / double(means.size());
    // Of n distances from their own mean one is not free.
    const double free = std::sqrt(double(means.size()) / double(means.size() - 1));
    for (const auto& mean : means) {
        distances_m.push_back(free * std::abs(normal.dot(mean - middle)));
    }
}

}  // namespace

SurfaceSpread surfaceSpread(const std::vector<SurfaceView>& keyframes) {
    std::map<Place, std::vector<PatchOfKeyframe>> cells;
    for (std::size_t k = 0; k < keyframes.size(); ++k) {
        for (const SurfacePatch& patch : keyframes[k].patches) {
            if (patch.position.allFinite()) cells[placeOf(patch)].push_back({k, &patch});
        }
    }
    std::vector<double> distances_m;
    for (const auto& cell : cells) addDistances(cell.second, distances_m);
    if (distances_m.empty()) return {};
    return {distances_m.size(), percentileOf(distances_m, 0.5), percentileOf(distances_m, 0.95)};
}

}  // namespace rgbd_graphslam
