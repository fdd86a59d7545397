/** Colored points from many views. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/mapping/surface_samples.h"

namespace rgbd_graphslam {

/** A colored point. */
struct MapPoint {
    Eigen::Vector3f position;  // m
    std::array<std::uint8_t, 3> rgb;
};

using PointMap = std::vector<MapPoint>;

/** One point a voxel: the mean of all readings in it, each weighted by how far it can be trusted.
 */
class PointFusion {
  public:
    explicit PointFusion(double voxel_m) : voxel_m_(voxel_m) {}

    void insert(const SE3& T_world_cam, const DepthView& view);

    /** In order of first sight. */
    PointMap points() const;

    std::size_t size() const { return voxels_.entries().size(); }
    std::size_t bytes() const { return voxels_.bytes(); }

  private:
    double voxel_m_;
    VoxelTable<SurfaceSample> voxels_;
};

}  // namespace rgbd_graphslam
