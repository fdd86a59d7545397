#include "rgbd_graphslam/mapping/occupancy_volume.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/free_space.h"
#include "rgbd_graphslam/mapping/surface_planes.h"

namespace rgbd_graphslam {
namespace {

constexpr int octree_reach = 32768;  // voxels from the origin that OctoMap's 16-bit keys can name

VoxelIndex blockOf(const VoxelIndex& v) {
    constexpr int bits = 3;
    static_assert(1 << bits == OccupancyVolume::block_size);
    return {v.x >> bits, v.y >> bits, v.z >> bits};
}

int indexInBlock(const VoxelIndex& v) {
    constexpr int mask = OccupancyVolume::block_size - 1;
    return OccupancyVolume::Block::indexOf(v.x & mask, v.y & mask, v.z & mask);
}

std::int8_t missed(std::int8_t value) {
    const int before = value == OccupancyVolume::unknown ? 0 : value;
    return static_cast<std::int8_t>(
        std::max(before + OccupancyVolume::miss, OccupancyVolume::lowest));
}

std::int8_t struck(std::int8_t value) {
    const int before = value == OccupancyVolume::unknown ? 0 : value;
    return static_cast<std::int8_t>(
        std::min(before + OccupancyVolume::hit, OccupancyVolume::highest));
}

/** Pixels that a voxel's face covers at the depth z (m). */
double pixelsOfVoxel(const Camera& camera, double voxel_m, double z) {
    return camera.pixelsPerSteradian() * voxel_m * voxel_m / (z * z);
}

/** Pixels to advance so that the farthest voxel still gets two readings along each axis. */
int samplingStep(const Camera& camera, double voxel_m, double max_range_m) {
    return std::max(1,
                    static_cast<int>(camera.pixelsPerRadian().x() * voxel_m / (2 * max_range_m)));
}

}  // namespace

OccupancyVolume::OccupancyVolume(double resolution_m, double hit_share)
    : resolution_m_(resolution_m), hit_share_(hit_share), cells_(resolution_m / 2) {
    if (!(resolution_m > 0)) throw Error("the resolution of an octree must be positive");
}

void OccupancyVolume::insert(const SE3& T_world_cam, const DepthView& view) {
    checkReach(T_world_cam, view.max_range_m);
    forEachFreeCube(T_world_cam, view, resolution_m_,
                    [this](const VoxelCube& cube) { addMiss(cube); });
    addHits(T_world_cam, view);
}

std::optional<int> OccupancyVolume::logOdds(const VoxelIndex& voxel) const {
    const auto* found = blocks_.find(voxelKey(blockOf(voxel)));
    if (!found) return std::nullopt;
    const std::int8_t value = (*found)->log_odds[indexInBlock(voxel)];
    return value == unknown ? std::nullopt : std::optional<int>(value);
}

std::optional<int> OccupancyVolume::logOdds(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3i v = (point_m / resolution_m_).array().floor().cast<int>();
    return logOdds(VoxelIndex{v.x(), v.y(), v.z()});
}

std::optional<Eigen::Vector3f> OccupancyVolume::color(const VoxelIndex& voxel) const {
    const ColorSum* found = colors_.find(voxelKey(voxel));
    if (!found) return std::nullopt;
    return found->sum / found->weight;
}

std::size_t OccupancyVolume::bytes() const {
    return blocks_.bytes() + blocks_.entries().size() * sizeof(Block) + colors_.bytes() +
           cells_.bytes() + frame_.bytes();
}

void OccupancyVolume::checkReach(const SE3& T_world_cam, double range_m) const {
    const double farthest = T_world_cam.t.cwiseAbs().maxCoeff() + 2 * range_m;
    const double limit = (octree_reach - block_size) * resolution_m_;
    if (farthest < limit) return;
    throw Error(
        "a keyframe " + std::to_string(farthest) +
            " m from the origin is out of reach for "
            "voxels of " +
            std::to_string(resolution_m_) + " m",
        "check the trajectory, or map at " + std::to_string(farthest / octree_reach * 1.01) + " m");
}

OccupancyVolume::Block& OccupancyVolume::block(const VoxelIndex& voxel) {
    auto& found = blocks_[voxelKey(blockOf(voxel))];
    if (!found) found = std::make_unique<Block>();
    return *found;
}

void OccupancyVolume::addMiss(const VoxelCube& cube) {
    const auto [x0, y0, z0] = cube.corner;
    if (cube.size < block_size) {
        auto& log_odds = block(cube.corner).log_odds;
        for (int z = z0; z < z0 + cube.size; ++z) {
            for (int y = y0; y < y0 + cube.size; ++y) {
                std::int8_t* row = &log_odds[indexInBlock({x0, y, z})];
                std::transform(row, row + cube.size, row, missed);
            }
        }
        return;
    }
    for (int z = z0; z < z0 + cube.size; z += block_size) {
        for (int y = y0; y < y0 + cube.size; y += block_size) {
            for (int x = x0; x < x0 + cube.size; x += block_size) {
                auto& log_odds = block({x, y, z}).log_odds;
                std::transform(log_odds.begin(), log_odds.end(), log_odds.begin(), missed);
            }
        }
    }
}

/** Into frame_ by voxel, and into the cells. */
void OccupancyVolume::sortReadings(const SE3& T_world_cam, const DepthView& view, int step) {
    frame_.clear();
    constexpr std::uint64_t none = ~0ull;
    std::uint64_t last_key = none;
    VoxelReadings* last = nullptr;  // neighboring runs often share a voxel
    SurfaceSampler(view, T_world_cam, cells_.cellSize(), step)
        .forEachRun([&](const VoxelIndex& cell, const SurfaceSample& run) {
            const std::uint64_t key = voxelKey({cell.x >> 1, cell.y >> 1, cell.z >> 1});
            if (key != last_key) last = &frame_[key];
            last_key = key;
            last->add(cell, run);
        });
    for (const auto& [key, readings] : frame_.entries()) cells_.add(voxelOfKey(key), readings);
}

void OccupancyVolume::addHits(const SE3& T_world_cam, const DepthView& view) {
    const Camera& camera = view.rays.camera();
    const int step = samplingStep(camera, resolution_m_, view.max_range_m);
    sortReadings(T_world_cam, view, step);
    const double share = hit_share_ / (step * step);
    const Eigen::Vector3d forward = T_world_cam.R.col(2);
    for (const auto& [key, in_voxel] : frame_.entries()) {
        const VoxelIndex voxel = voxelOfKey(key);
        const Eigen::Vector3d center =
            resolution_m_ * (Eigen::Vector3d(voxel.x, voxel.y, voxel.z).array() + 0.5);
        const double z = std::max(resolution_m_, forward.dot(center - T_world_cam.t));
        if (in_voxel.readings < share * pixelsOfVoxel(camera, resolution_m_, z)) continue;
        std::int8_t& value = block(voxel).log_odds[indexInBlock(voxel)];
        value = struck(value);
        ColorSum& color = colors_[key];
        color.sum += in_voxel.color;
        color.weight += in_voxel.weight();
    }
}

void OccupancyVolume::removeNoiseVoxels() {
    const SurfacePlanes planes(cells_);
    for (const auto& entry : colors_.entries()) {
        const VoxelIndex voxel = voxelOfKey(entry.key);
        std::int8_t& value = block(voxel).log_odds[indexInBlock(voxel)];
        if (value >= 0 && !planes.cross(voxel)) value = unknown;
    }
}

}  // namespace rgbd_graphslam
