#include "rgbd_graphslam/mapping/point_fusion.h"

#include <cmath>

namespace rgbd_graphslam {
namespace {

std::uint8_t channel(float value) {
    return static_cast<std::uint8_t>(std::lround(value));
}

}  // namespace

void PointFusion::insert(const SE3& T_world_cam, const DepthView& view) {
    SurfaceSampler(view, T_world_cam, voxel_m_)
        .forEachRun([&](const VoxelIndex& voxel, const SurfaceSample& run) {
            voxels_[voxelKey(voxel)].add(run);
        });
}

PointMap PointFusion::points() const {
    PointMap points;
    points.reserve(voxels_.entries().size());
    for (const auto& [key, sum] : voxels_.entries()) {
        const VoxelIndex v = voxelOfKey(key);
        const Eigen::Vector3d mean = (sum.offset / sum.weight).cast<double>();
        const Eigen::Vector3f bgr = sum.color / sum.weight;
        points.push_back({(voxel_m_ * (Eigen::Vector3d(v.x, v.y, v.z) + mean)).cast<float>(),
                          {channel(bgr[2]), channel(bgr[1]), channel(bgr[0])}});
    }
    return points;
}

}  // namespace rgbd_graphslam
