#include "rgbd_graphslam/evaluation/octree_accuracy.h"

#include <octomap/OcTree.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <unordered_set>
#include <vector>

#include "rgbd_graphslam/evaluation/commands.h"
#include "rgbd_graphslam/geometry/surface_sampling.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/voxel_table.h"
#include "rgbd_graphslam/metrics/ate.h"

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

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

/** The octree, voxel by voxel. */
struct KnownVoxels {
    std::unordered_set<std::uint64_t> occupied, free;

    explicit KnownVoxels(const octomap::OcTree& tree) {
        forEachKnown(tree, [this](std::uint64_t voxel, bool is_occupied) {
            (is_occupied ? occupied : free).insert(voxel);
        });
    }
};

/** Where the surface is, by voxel of the octree. */
class SurfaceVoxels {
  public:
    SurfaceVoxels(const KnownVoxels& known, double edge_m, double tolerance_m)
        : known_(known), edge_m_(edge_m), tolerance_m_(tolerance_m) {}

    /** \param p in the frame of the octree \param seen_area_m2 that the sample stands for; 0 when
     *  no camera saw it */
    void sample(const Eigen::Vector3d& p, double seen_area_m2) {
        const std::uint64_t here = voxelKey(voxelOf(p, edge_m_));
        inside_.insert(here);
        bool confirmed = false;
        forEachVoxelNear(p, tolerance_m_, edge_m_, [&](std::uint64_t voxel) {
            near_.insert(voxel);
            confirmed = confirmed || known_.occupied.count(voxel);
        });
        if (confirmed) confirmed_.insert(here);
        seen_m2_ += seen_area_m2;
        if (known_.occupied.count(here)) occupied_m2_ += seen_area_m2;
        if (confirmed) confirmed_m2_ += seen_area_m2;
        if (known_.free.count(here)) free_m2_ += seen_area_m2;
    }

    OctreeAccuracy accuracy() const {
        OctreeAccuracy result;
        std::size_t hits = 0, near_hits = 0, wrong = 0;
        const auto count = [&](const std::unordered_set<std::uint64_t>& voxels, bool is_occupied) {
            for (const std::uint64_t voxel : voxels) {
                if (inside_.count(voxel)) {
                    ++result.surface_voxels;
                    hits += is_occupied;
                    near_hits += confirmed_.count(voxel);
                } else if (!near_.count(voxel)) {
                    ++result.free_voxels;
                    wrong += is_occupied;
                }
            }
        };
        count(known_.occupied, true);
        count(known_.free, false);
        const auto surface = static_cast<double>(result.surface_voxels);
        result.surface_occupied = share(static_cast<double>(hits), surface);
        result.surface_occupied_within_tolerance = share(static_cast<double>(near_hits), surface);
        result.free_occupied =
            share(static_cast<double>(wrong), static_cast<double>(result.free_voxels));
        return result;
    }

    SeenSurface seen() const {
        return {seen_m2_, share(occupied_m2_, seen_m2_), share(confirmed_m2_, seen_m2_),
                share(free_m2_, seen_m2_)};
    }

  private:
    const KnownVoxels& known_;
    double edge_m_, tolerance_m_;
    std::unordered_set<std::uint64_t> inside_, near_;
    std::unordered_set<std::uint64_t> confirmed_;  // of inside_: an occupied voxel is near
    double seen_m2_ = 0, occupied_m2_ = 0, confirmed_m2_ = 0, free_m2_ = 0;
};

std::vector<Figure> figuresOf(const OctreeAccuracy& accuracy) {
    const auto percent = [](const std::string& name, double value) {
        return Figure{name, 100 * value, "%", 2};
    };
    std::vector<Figure> figures = {
        {"surface_voxels", static_cast<double>(accuracy.surface_voxels), "voxels", 0},
        percent("surface_occupied", accuracy.surface_occupied),
        percent("surface_occupied_within_tolerance", accuracy.surface_occupied_within_tolerance),
        {"free_voxels", static_cast<double>(accuracy.free_voxels), "voxels", 0},
        percent("free_occupied", accuracy.free_occupied)};
    if (!accuracy.seen) return figures;
    figures.push_back({"seen_surface", accuracy.seen->area_m2, "m2", 2});
    figures.push_back(percent("seen_occupied", accuracy.seen->occupied));
    figures.push_back(
        percent("seen_occupied_within_tolerance", accuracy.seen->occupied_within_tolerance));
    figures.push_back(percent("seen_free", accuracy.seen->free));
    return figures;
}

}  // namespace

OctreeAccuracy evaluateOctree(const octomap::OcTree& tree, const PlyModel& surface,
                              const Similarity& truth_from_map, double tolerance_m,
                              const SurfaceSight* sight) {
    const double edge_m = tree.getResolution();
    const SE3 T_map_truth = truth_from_map.motion.inverse();
    const KnownVoxels known(tree);
    SurfaceVoxels voxels(known, edge_m, tolerance_m);
    forEachSurfaceSample(surface, edge_m / 5, [&](const Eigen::Vector3d& p, double area_m2) {
        voxels.sample(T_map_truth * p, sight && sight->sees(p) ? area_m2 : 0);
    });
    OctreeAccuracy accuracy = voxels.accuracy();
    if (sight) accuracy.seen = voxels.seen();
    return accuracy;
}

std::string runOctreeEvaluation(const OctreeRequest& request) {
    const auto tree = loadBinaryOcTree(request.map);
    const PlyModel surface = readPly(request.surface);
    const auto sight = sightOf(request, surface);
    const auto accuracy = evaluateOctree(*tree, surface, alignmentOf(request), request.tolerance_m,
                                         sight ? &*sight : nullptr);
    return format({{std::filesystem::path(request.map).stem(), figuresOf(accuracy)}},
                  request.format);
}

}  // namespace rgbd_graphslam
