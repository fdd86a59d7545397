#include "rgbd_graphslam/mapping/dense_mapper.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
}

}  // namespace

DenseMapper::DenseMapper(const MapOptions& options, const Camera& camera)
    : options_(options),
      rays_(camera),
      points_(options.point_voxel_m),
      octree_volume_(options.octree_resolution_m, options.hit_share) {
    if (options.grid_resolution_m != options.octree_resolution_m) {
        grid_volume_ =
            std::make_unique<OccupancyVolume>(options.grid_resolution_m, options.hit_share);
    }
}

void DenseMapper::insert(const SE3& T_world_cam, const RgbdImage& image) {
    if (!T_world_cam.R.allFinite() || !T_world_cam.t.allFinite()) {
        throw Error(
            "the pose of the keyframe at " + std::to_string(image.stamp_s) + " s is not finite",
            "check the trajectory");
    }
    const DepthView view(image, rays_, options_);
    octree_volume_.insert(T_world_cam, view);
    if (grid_volume_) grid_volume_->insert(T_world_cam, view);
    points_.insert(T_world_cam, view);
    ++keyframes_;
    checkMemory();
}

PointMap DenseMapper::points() const {
    PointMap all = points_.points();
    if (!options_.drop_points_in_free_space) return all;
    const auto in_free_space = [&](const MapPoint& point) {
        const auto log_odds = octree_volume_.logOdds(point.position.cast<double>().eval());
        return log_odds && *log_odds < 0;
    };
    all.erase(std::remove_if(all.begin(), all.end(), in_free_space), all.end());
    return all;
}

std::unique_ptr<octomap::OcTree> DenseMapper::octree(LeafValues values) const {
    return toOcTree(octree_volume_, values);
}

std::unique_ptr<octomap::ColorOcTree> DenseMapper::colorOctree() const {
    return toColorOcTree(octree_volume_);
}

void DenseMapper::grid(mrpt::maps::COccupancyGridMap2D& grid) const {
    buildGrid(gridVolume(), options_, grid);
}

std::size_t DenseMapper::bytes() const {
    return points_.bytes() + octree_volume_.bytes() + (grid_volume_ ? grid_volume_->bytes() : 0);
}

void DenseMapper::checkMemory() const {
    // Writing the files needs about as much again: the points once more, and the octree's nodes.
    const double needed_mb = 2e-6 * static_cast<double>(bytes());
    if (needed_mb <= options_.memory_limit_mb) return;
    const double excess = needed_mb / options_.memory_limit_mb;
    // Blocks and points both follow the surface or less than the cube of the resolution.
    const double coarser = std::cbrt(excess) * 1.26;
    const bool points_dominate = points_.bytes() > bytes() / 2;
    const char* key = points_dominate ? "point_voxel_m"
                      : grid_volume_ && grid_volume_->bytes() > octree_volume_.bytes()
                          ? "grid_resolution_m"
                          : "octree_resolution_m";
    const double now = points_dominate ? options_.point_voxel_m
                       : key[0] == 'g' ? options_.grid_resolution_m
                                       : options_.octree_resolution_m;
    throw Error("after " + std::to_string(keyframes_) + " keyframes the maps need " +
                    shortNumber(needed_mb) +
                    " MB, more than memory_limit_mb = " + std::to_string(options_.memory_limit_mb),
                std::string("set ") + key + " to " + shortNumber(now * coarser) + " or coarser");
}

}  // namespace rgbd_graphslam
