#include "rgbd_graphslam/mapping/dense_mapper.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/mesh_parts.h"
#include "rgbd_graphslam/mapping/surface_nets.h"

namespace rgbd_graphslam {
namespace {

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
}

/** With finer ones a single keyframe could fill the memory. */
void checkMeshVoxel(double voxel_m) {
    constexpr double finest_m = 0.005;
    if (voxel_m >= finest_m) return;
    throw Error("a mesh of " + shortNumber(voxel_m) + " m is finer than depth images can tell",
                "set mesh_voxel_m to " + shortNumber(finest_m) + " or more, or to 0 for no mesh");
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
    if (options.mesh_voxel_m > 0) {
        checkMeshVoxel(options.mesh_voxel_m);
        mesh_volume_ = std::make_unique<TsdfVolume>(options.mesh_voxel_m);
    }
}

void DenseMapper::insert(const SE3& T_world_cam, const DepthView& view) {
    if (!T_world_cam.R.allFinite() || !T_world_cam.t.allFinite()) {
        throw Error(
            "the pose of the keyframe at " + std::to_string(view.stamp_s) + " s is not finite",
            "check the trajectory");
    }
    octree_volume_.insert(T_world_cam, view);
    if (grid_volume_) grid_volume_->insert(T_world_cam, view);
    points_.insert(T_world_cam, view);
    if (mesh_volume_) mesh_volume_->insert(T_world_cam, view);
    ++keyframes_;
}

void DenseMapper::finish() {
    octree_volume_.removeNoiseVoxels();
    if (grid_volume_) grid_volume_->removeNoiseVoxels();
}

PointMap DenseMapper::points() const {
    PointMap all = points_.points();
    if (!options_.drop_points_in_free_space) return all;
    const auto is_gone = [&](const MapPoint& point) { return inFreeSpace(point.position); };
    all.erase(std::remove_if(all.begin(), all.end(), is_gone), all.end());
    return all;
}

bool DenseMapper::inFreeSpace(const Eigen::Vector3f& point) const {
    const auto log_odds = octree_volume_.logOdds(point.cast<double>().eval());
    return log_odds && *log_odds < 0;
}

PlyModel DenseMapper::mesh() const {
    if (!mesh_volume_) throw Error("no mesh was asked for", "set mesh_voxel_m");
    PlyModel mesh = surfaceOf(mesh_volume_->blocks(), options_.mesh_voxel_m);
    if (options_.drop_points_in_free_space) {
        const auto is_gone = [&](const auto& triangle) {
            return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
                return inFreeSpace(mesh.vertices[vertex]);
            });
        };
        auto& triangles = mesh.triangles;
        triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_gone),
                        triangles.end());
    }
    mesh = withoutSmallParts(mesh, options_.mesh_min_part_m2);
    addNormals(mesh);
    return mesh;
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
    return points_.bytes() + octree_volume_.bytes() + meshBytes() +
           (grid_volume_ ? grid_volume_->bytes() : 0);
}

void DenseMapper::checkMemory(double share) const {
    constexpr double trusted_share = 0.1, forecast_slack = 1.25;
    // Writing the files needs about as much again: the points once more, and the octree's nodes.
    const double now_mb = 2e-6 * static_cast<double>(bytes());
    const double all_mb = now_mb / std::max(share, 0.01), limit_mb = options_.memory_limit_mb;
    const bool will_fit = share < trusted_share || all_mb <= forecast_slack * limit_mb;
    if (now_mb <= limit_mb && will_fit) return;
    throw Error("the maps of all keyframes need about " + std::to_string(std::lround(all_mb)) +
                    " MB, more than memory_limit_mb = " + std::to_string(options_.memory_limit_mb),
                "set " + coarserResolutions(all_mb / now_mb) + " or coarser");
}

/** Each part gets the same share of the limit; its memory falls at least with the square of the
 *  resolution, as surfaces do. */
std::string DenseMapper::coarserResolutions(double growth) const {
    constexpr double spare = 1.1;
    const int parts = 2 + (grid_volume_ ? 1 : 0) + (mesh_volume_ ? 1 : 0);
    const double part_limit_mb = static_cast<double>(options_.memory_limit_mb) / parts;
    std::string keys;
    const auto name = [&](const char* key, double resolution_m, std::size_t part) {
        const double part_mb = growth * 2e-6 * static_cast<double>(part);
        if (part_mb <= part_limit_mb) return;
        keys += (keys.empty() ? "" : " and ") + std::string(key) + " to " +
                shortNumber(spare * std::sqrt(part_mb / part_limit_mb) * resolution_m);
    };
    name("point_voxel_m", options_.point_voxel_m, points_.bytes());
    name("octree_resolution_m", options_.octree_resolution_m, octree_volume_.bytes());
    if (grid_volume_) name("grid_resolution_m", options_.grid_resolution_m, grid_volume_->bytes());
    if (mesh_volume_) name("mesh_voxel_m", options_.mesh_voxel_m, mesh_volume_->bytes());
    return keys;
}

}  // namespace rgbd_graphslam
