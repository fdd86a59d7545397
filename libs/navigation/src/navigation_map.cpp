#include "rgbd_graphslam/navigation/navigation_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <unordered_set>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {
namespace {

using mrpt::maps::COccupancyGridMap2D;

constexpr float surely_free = 0.6f;

VoxelIndex voxelOf(const Eigen::Vector3f& p, double edge_m) {
    const Eigen::Array3i v = (p.cast<double>() / edge_m).array().floor().cast<int>();
    return {v.x(), v.y(), v.z()};
}

PointMap obstaclesAmong(const PointMap& points, const DriveOptions& options, double height_m) {
    PointMap obstacles;
    std::unordered_set<std::uint64_t> taken;
    for (const MapPoint& point : points) {
        const double z = point.position.z();
        if (z < options.floor_clearance_m || z > height_m) continue;
        if (taken.insert(voxelKey(voxelOf(point.position, options.obstacle_voxel_m))).second)
            obstacles.push_back(point);
    }
    return obstacles;
}

bool discIsFree(const COccupancyGridMap2D& grid, int cx, int cy, int radius) {
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            if (x * x + y * y > radius * radius) continue;
            if (!(grid.getCell(cx + x, cy + y) > surely_free)) return false;
        }
    }
    return true;
}

/** "x,y" of the free disc nearest to a cell, empty without any. */
std::string nearestFree(const COccupancyGridMap2D& grid, int cx, int cy, int radius) {
    double nearest = std::numeric_limits<double>::infinity();
    char text[64] = "";
    for (int y = 0; y < static_cast<int>(grid.getSizeY()); ++y) {
        for (int x = 0; x < static_cast<int>(grid.getSizeX()); ++x) {
            const double distance = std::hypot(x - cx, y - cy);
            if (distance >= nearest || !discIsFree(grid, x, y, radius)) continue;
            nearest = distance;
            std::snprintf(text, sizeof(text), "%.2f,%.2f", grid.idx2x(x), grid.idx2y(y));
        }
    }
    return text;
}

bool besideFree(const COccupancyGridMap2D& grid, int x, int y) {
    for (int v = -1; v <= 1; ++v) {
        for (int u = -1; u <= 1; ++u) {
            if (grid.getCell(x + u, y + v) > surely_free) return true;
        }
    }
    return false;
}

}  // namespace

std::vector<mrpt::math::TPoint2D> bordersOf(const COccupancyGridMap2D& grid) {
    std::vector<mrpt::math::TPoint2D> borders;
    for (int y = 0; y < static_cast<int>(grid.getSizeY()); ++y) {
        for (int x = 0; x < static_cast<int>(grid.getSizeX()); ++x) {
            if (grid.getCell(x, y) > surely_free || !besideFree(grid, x, y)) continue;
            borders.emplace_back(grid.idx2x(x), grid.idx2y(y));
        }
    }
    return borders;
}

NavigationMap loadNavigationMap(const std::string& run_folder, const DriveOptions& options,
                                double height_m) {
    const std::filesystem::path folder(run_folder);
    NavigationMap map;
    map.grid = loadGridMap((folder / "grid.gridmap.gz").string());
    map.obstacles = obstaclesAmong(loadPly((folder / "points.ply").string()), options, height_m);
    map.borders = bordersOf(map.grid);
    return map;
}

void requireFree(const COccupancyGridMap2D& grid, const mrpt::math::TPoint2D& place,
                 double radius_m, const std::string& what) {
    const int x = grid.x2idx(place.x), y = grid.y2idx(place.y);
    const int radius = static_cast<int>(std::ceil(radius_m / grid.getResolution()));
    if (discIsFree(grid, x, y, radius)) return;
    char where[64];
    std::snprintf(where, sizeof(where), "%.2f,%.2f", place.x, place.y);
    const std::string better = nearestFree(grid, x, y, radius);
    throw Error("the " + what + " " + where + " is not free in the grid for a robot of radius " +
                    std::to_string(radius_m).substr(0, 4) + " m",
                better.empty() ? "no place is: use a smaller robot or map more"
                               : "the nearest place that is: " + better);
}

}  // namespace rgbd_graphslam
