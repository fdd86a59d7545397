/** The volume against its definition, spelled out without hierarchies, early answers or caches. */
#include "rgbd_graphslam/mapping/occupancy_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>

#include "box_room.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

constexpr double voxel_m = 0.1;
constexpr double hit_share = 0.05;

/** Whether a view sees a cube wholly before its readings. */
class FreeByDefinition {
  public:
    FreeByDefinition(const SE3& T_world_cam, const DepthView& view)
        : T_(T_world_cam), R_cam_world_(T_.R.transpose().cast<float>()), view_(view) {}

    /** Some cube of the octree around the voxel, or itself, is free. */
    bool voxel(const VoxelIndex& v) {
        for (int size = 64; size >= 1; size /= 2) {
            const VoxelIndex corner{v.x & -size, v.y & -size, v.z & -size};
            if (cached({corner, size})) return true;
        }
        return false;
    }

  private:
    bool cached(const VoxelCube& cube) {
        auto& of_size = known_[cube.size];
        const auto key = voxelKey(cube.corner);
        if (of_size.count(key) == 0) of_size[key] = free(cube);
        return of_size[key];
    }

    bool free(const VoxelCube& cube) const {
        const double half = 0.5 * cube.size;
        const Eigen::Vector3d center(cube.corner.x + half, cube.corner.y + half,
                                     cube.corner.z + half);
        const Eigen::Vector3f c = R_cam_world_ * (voxel_m * center - T_.t).cast<float>();
        const Eigen::Vector3f reach =
            R_cam_world_.cwiseAbs().rowwise().sum() * static_cast<float>(0.5 * voxel_m);
        const Eigen::Vector3f low = c - cube.size * reach, high = c + cube.size * reach;
        if (low.z() < 0.05f || high.z() > static_cast<float>(view_.max_range_m)) return false;
        const Intrinsics camera = view_.rays.camera().intrinsics();
        const auto [u0, u1] = span(low.x(), high.x(), low.z(), high.z(), camera.fx, camera.cx);
        const auto [v0, v1] = span(low.y(), high.y(), low.z(), high.z(), camera.fy, camera.cy);
        const cv::Rect whole(cv::Point(u0, v0), cv::Point(u1 + 1, v1 + 1));
        const cv::Rect seen = whole & cv::Rect(0, 0, camera.width, camera.height);
        if (seen.empty() || nearestAround(seen) <= high.z()) return false;
        const double needed = cube.size == 1 ? 0.5 * whole.area() : whole.area();
        return cv::countNonZero(view_.depth(seen)) >= needed;
    }

    /** Of the pixels that a span of a box may be seen at. */
    static std::pair<int, int> span(float low, float high, float near, float far, double f,
                                    double c) {
        const float at_near = 1 / near, at_far = 1 / far;
        return {static_cast<int>(std::floor(f * std::min(low * at_near, low * at_far) + c)),
                static_cast<int>(std::ceil(f * std::max(high * at_near, high * at_far) + c))};
    }

    /** Over whole tiles, of the smallest power of two that has the rectangle within five across. */
    float nearestAround(const cv::Rect& rect) const {
        int tile = 1;
        while (std::max(rect.width, rect.height) - 1 >= 4 * tile) tile *= 2;
        float nearest = std::numeric_limits<float>::infinity();
        const cv::Mat1f& depth = view_.depth;
        for (int v = rect.y / tile * tile;
             v < std::min(((rect.br().y - 1) / tile + 1) * tile, depth.rows); ++v) {
            for (int u = rect.x / tile * tile;
                 u < std::min(((rect.br().x - 1) / tile + 1) * tile, depth.cols); ++u) {
                if (depth(v, u) > 0) nearest = std::min(nearest, depth(v, u));
            }
        }
        return nearest;
    }

    SE3 T_;
    Eigen::Matrix3f R_cam_world_;
    const DepthView& view_;
    std::map<int, std::map<std::uint64_t, bool>> known_;
};

/** Readings in each voxel: of every second pixel, which is how far apart voxels of 10 cm are read
 *  at 5 m. */
std::map<std::uint64_t, int> readingsIn(const SE3& T_world_cam, const DepthView& view) {
    std::map<std::uint64_t, int> readings;
    SurfaceSampler(view, T_world_cam, voxel_m / 2, 2)
        .forEachRun([&](const VoxelIndex& cell, const SurfaceSample& run) {
            readings[voxelKey({cell.x >> 1, cell.y >> 1, cell.z >> 1})] += run.readings;
        });
    return readings;
}

bool isHit(const VoxelIndex& v, int readings, const SE3& T_world_cam, const CameraModel& camera) {
    const Eigen::Vector3d center =
        voxel_m * (Eigen::Vector3d(v.x, v.y, v.z) + Eigen::Vector3d::Constant(0.5));
    const double z = std::max(voxel_m, (T_world_cam.inverse() * center).z());
    const double pixels = camera.pixelsPerSteradian() * voxel_m * voxel_m / (z * z);
    return readings >= hit_share * pixels / 4;
}

std::optional<int> updated(std::optional<int> value, int step) {
    return std::clamp(value.value_or(0) + step, OccupancyVolume::lowest, OccupancyVolume::highest);
}

TEST(OccupancyVolume, isWhatItsDefinitionSaysVoxelByVoxel) {
    const CameraModel camera = smallCamera();
    const RayTable rays(camera);
    const MapOptions options;
    Noise noise;
    OccupancyVolume volume(voxel_m, hit_share);
    std::map<std::uint64_t, std::optional<int>> expected;
    for (const SE3& T : walk(4)) {
        const DepthView view(render(BoxRoom(), camera, T, 0, &noise), rays, options);
        volume.insert(T, view);
        FreeByDefinition free(T, view);
        auto readings = readingsIn(T, view);
        for (int x = -34; x < 34; ++x) {
            for (int y = -24; y < 24; ++y) {
                for (int z = -4; z < 28; ++z) {
                    const VoxelIndex voxel{x, y, z};
                    auto& value = expected[voxelKey(voxel)];
                    if (free.voxel(voxel)) value = updated(value, OccupancyVolume::miss);
                    const auto found = readings.find(voxelKey(voxel));
                    if (found != readings.end() && isHit(voxel, found->second, T, camera))
                        value = updated(value, OccupancyVolume::hit);
                }
            }
        }
    }
    int free = 0, occupied = 0;
    for (const auto& [key, value] : expected) {
        const VoxelIndex v = voxelOfKey(key);
        ASSERT_EQ(volume.logOdds(v), value) << v.x << " " << v.y << " " << v.z;
        free += value && *value < 0;
        occupied += value && *value >= 0;
    }
    EXPECT_GT(free, 20000);
    EXPECT_GT(occupied, 2000);
}

}  // namespace
}  // namespace rgbd_graphslam
