/** Dense maps from depth images with known poses. */
#pragma once
#include <memory>

#include "rgbd_graphslam/mapping/grid_builder.h"
#include "rgbd_graphslam/mapping/octree_builder.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** Takes keyframes one by one; the maps can be asked for at any time. World coordinates are those
 * of the poses given; the grid needs them upright with the floor at z = 0. */
class DenseMapper {
  public:
    DenseMapper(const MapOptions& options, const Camera& camera);

    /** \throws Error when the pose is not finite, the image does not fit the camera, or the maps
     *          outgrow memory_limit_mb, naming the resolution that would fit */
    void insert(const SE3& T_world_cam, const RgbdImage& image);

    /** Fused points, without those in free space when so set. */
    PointMap points() const;

    std::unique_ptr<octomap::OcTree> octree(LeafValues values = LeafValues::Exact) const;
    std::unique_ptr<octomap::ColorOcTree> colorOctree() const;
    void grid(mrpt::maps::COccupancyGridMap2D& grid) const;

    const OccupancyVolume& volume() const { return octree_volume_; }
    int keyframes() const { return keyframes_; }
    std::size_t bytes() const;

  private:
    void checkMemory() const;
    const OccupancyVolume& gridVolume() const {
        return grid_volume_ ? *grid_volume_ : octree_volume_;
    }

    MapOptions options_;
    RayTable rays_;
    PointFusion points_;
    OccupancyVolume octree_volume_;
    std::unique_ptr<OccupancyVolume> grid_volume_;  // only when its resolution differs
    int keyframes_ = 0;
};

}  // namespace rgbd_graphslam
