#include "rgbd_graphslam/mapping/octree_accuracy.h"

#include <octomap/OcTree.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <unordered_set>

#include "rgbd_graphslam/evaluation/ate.h"
#include "rgbd_graphslam/evaluation/commands.h"
#include "rgbd_graphslam/evaluation/surface_sampling.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {
namespace {

using Visit = std::function<void(std::uint64_t)>;

VoxelIndex voxelOf(const Eigen::Vector3d& p, double edge_m) {
    const Eigen::Array3i v = (p / edge_m).array().floor().cast<int>();
    return {v.x(), v.y(), v.z()};
}

/** Voxels that a cube about p touches. */
void forEachVoxelNear(const Eigen::Vector3d& p, double reach_m, double edge_m, const Visit& visit) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(reach_m);
    const VoxelIndex low = voxelOf(p - reach, edge_m), high = voxelOf(p + reach, edge_m);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) visit(voxelKey({x, y, z}));
        }
    }
}

/** Calls visit(voxel, occupied) for all known voxels; large leaves are taken apart. */
void forEachKnown(const octomap::OcTree& tree,
                  const std::function<void(std::uint64_t, bool)>& visit) {
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
        const double edge_m = tree.getResolution();
        const double inset = (leaf.getSize() - edge_m) / 2;
        const int count = static_cast<int>(std::lround(leaf.getSize() / edge_m));
        const VoxelIndex low =
            voxelOf({leaf.getX() - inset, leaf.getY() - inset, leaf.getZ() - inset}, edge_m);
        const bool occupied = tree.isNodeOccupied(*leaf);
        for (int z = 0; z < count; ++z) {
            for (int y = 0; y < count; ++y) {
                for (int x = 0; x < count; ++x)
                    visit(voxelKey({low.x + x, low.y + y, low.z + z}), occupied);
            }
        }
    }
}

/** Where the surface is, by voxel of the octree. */
struct SurfaceVoxels {
    std::unordered_set<std::uint64_t> inside, near;
    std::unordered_set<std::uint64_t>
        confirmed;  // of inside: an occupied voxel is within tolerance
};

SurfaceVoxels voxelsOf(const PlyModel& surface, const SE3& T_map_truth, double edge_m,
                       double tolerance_m, const std::unordered_set<std::uint64_t>& occupied) {
    SurfaceVoxels voxels;
    forEachSurfaceSample(surface, edge_m / 5, [&](const Eigen::Vector3d& sample, double) {
        const Eigen::Vector3d p = T_map_truth * sample;
        const std::uint64_t here = voxelKey(voxelOf(p, edge_m));
        voxels.inside.insert(here);
        forEachVoxelNear(p, tolerance_m, edge_m, [&](std::uint64_t voxel) {
            voxels.near.insert(voxel);
            if (occupied.count(voxel)) voxels.confirmed.insert(here);
        });
    });
    return voxels;
}

double share(std::size_t part, std::size_t whole) {
    return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

}  // namespace

OctreeAccuracy evaluateOctree(const octomap::OcTree& tree, const PlyModel& surface,
                              const Similarity& truth_from_map, double tolerance_m) {
    std::unordered_set<std::uint64_t> occupied;
    forEachKnown(tree, [&](std::uint64_t voxel, bool is_occupied) {
        if (is_occupied) occupied.insert(voxel);
    });
    const auto voxels = voxelsOf(surface, truth_from_map.motion.inverse(), tree.getResolution(),
                                 tolerance_m, occupied);
    OctreeAccuracy accuracy;
    std::size_t hits = 0, near_hits = 0, wrong = 0;
    forEachKnown(tree, [&](std::uint64_t voxel, bool is_occupied) {
        if (voxels.inside.count(voxel)) {
            ++accuracy.surface_voxels;
            hits += is_occupied;
            near_hits += voxels.confirmed.count(voxel);
        } else if (!voxels.near.count(voxel)) {
            ++accuracy.free_voxels;
            wrong += is_occupied;
        }
    });
    accuracy.surface_occupied = share(hits, accuracy.surface_voxels);
    accuracy.surface_occupied_within_tolerance = share(near_hits, accuracy.surface_voxels);
    accuracy.free_occupied = share(wrong, accuracy.free_voxels);
    return accuracy;
}

std::string runOctreeEvaluation(const OctreeRequest& request) {
    const auto tree = loadBinaryOcTree(request.map);
    const auto accuracy =
        evaluateOctree(*tree, readPly(request.surface), alignmentOf(request), request.tolerance_m);
    const auto percent = [](double value) { return 100 * value; };
    Report report{std::filesystem::path(request.map).stem(), {}};
    report.figures = {{"surface_voxels", static_cast<double>(accuracy.surface_voxels), "voxels", 0},
                      {"surface_occupied", percent(accuracy.surface_occupied), "%", 2},
                      {"surface_occupied_within_tolerance",
                       percent(accuracy.surface_occupied_within_tolerance), "%", 2},
                      {"free_voxels", static_cast<double>(accuracy.free_voxels), "voxels", 0},
                      {"free_occupied", percent(accuracy.free_occupied), "%", 2}};
    return format({report}, request.format);
}

}  // namespace rgbd_graphslam
