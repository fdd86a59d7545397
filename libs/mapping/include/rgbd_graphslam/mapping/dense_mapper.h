/** Dense maps from depth images with known poses. */
#pragma once
#include <memory>
#include <string>

#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/mapping/grid_builder.h"
#include "rgbd_graphslam/mapping/octree_builder.h"
#include "rgbd_graphslam/mapping/point_fusion.h"
#include "rgbd_graphslam/mapping/tsdf_volume.h"

namespace rgbd_graphslam {

/** Takes keyframes one by one; the maps can be asked for at any time. World coordinates are those
 * of the poses given; the grid needs them upright with the floor at z = 0. */
class DenseMapper {
  public:
    /** \throws Error when a mesh is asked for that is too fine */
    DenseMapper(const MapOptions& options, const Camera& camera);

    /** What insert() takes; valid as long as this. \throws Error when it does not fit the camera */
    DepthView view(const RgbdImage& image) const { return {image, rays_, options_}; }

    /** \throws Error when the pose is not finite */
    void insert(const SE3& T_world_cam, const DepthView& view);
    void insert(const SE3& T_world_cam, const RgbdImage& image) {
        insert(T_world_cam, view(image));
    }

    /** \param share of the whole that is inserted by now, in (0, 1]; see ViewCoverage
     *  \throws Error when the maps outgrow memory_limit_mb, or will when all is inserted, naming
     * the resolutions that would fit. A forecast from less than a tenth is not trusted */
    void checkMemory(double share = 1) const;

    /** Takes back what noise alone made occupied; to be called after the last keyframe. */
    void finish();

    /** Fused points, without those in free space when so set. */
    PointMap points() const;

    /** Whether options ask for a mesh. */
    bool hasMesh() const { return mesh_volume_ != nullptr; }
    /** Triangles with colors and normals, without those in free space when so set. \throws Error
     * without hasMesh() */
    PlyModel mesh() const;

    std::unique_ptr<octomap::OcTree> octree(LeafValues values = LeafValues::Exact) const;
    std::unique_ptr<octomap::ColorOcTree> colorOctree() const;
    void grid(mrpt::maps::COccupancyGridMap2D& grid) const;

    const OccupancyVolume& volume() const { return octree_volume_; }
    int keyframes() const { return keyframes_; }
    std::size_t bytes() const;
    std::size_t pointBytes() const { return points_.bytes(); }
    std::size_t octreeBytes() const { return octree_volume_.bytes(); }
    std::size_t meshBytes() const { return mesh_volume_ ? mesh_volume_->bytes() : 0; }

  private:
    /** Whether most views look through the place. */
    bool inFreeSpace(const Eigen::Vector3f& point) const;
    /** \param growth factor on the memory until all is inserted */
    std::string coarserResolutions(double growth) const;
    const OccupancyVolume& gridVolume() const {
        return grid_volume_ ? *grid_volume_ : octree_volume_;
    }

    MapOptions options_;
    RayTable rays_;
    PointFusion points_;
    OccupancyVolume octree_volume_;
    std::unique_ptr<OccupancyVolume> grid_volume_;  // only when its resolution differs
    std::unique_ptr<TsdfVolume> mesh_volume_;       // only when asked for
    int keyframes_ = 0;
};

}  // namespace rgbd_graphslam
