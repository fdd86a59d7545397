/** How far space is from the surface next to it. */
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/depth_view.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {

/** A truncated signed distance field: weighted means over all views (Curless and Levoy, "A
 *  volumetric method for building complex models from range images", SIGGRAPH 1996), kept in blocks
 *  near surfaces only (Niessner et al., "Real-time 3D reconstruction at scale using voxel hashing",
 *  ACM Transactions on Graphics 2013). A voxel stands for the point at its index times the edge. */
class TsdfVolume {
  public:
    static constexpr int block_size = 8;

    struct Voxel {
        float distance_m = 0;  // from the surface; negative behind it
        float weight = 0;      // sum over the views; 0 where none saw the voxel
        /** Mean BGR of the views that found surface nearby, in steps of 1 / color_steps, so that
         *  small changes are not lost in rounding. */
        std::array<std::uint16_t, 3> color{};
        std::uint16_t color_views = 0;
    };
    static constexpr float color_steps = 256;

    struct Block {
        std::array<Voxel, block_size * block_size * block_size> voxels;
        int last_view = 0;  // that had a reading near it
        /** \param x,y,z from 0 to block_size - 1 */
        static int indexOf(int x, int y, int z) { return (z * block_size + y) * block_size + x; }
    };

    /** \throws Error when the edge is not positive */
    explicit TsdfVolume(double voxel_m);

    /** Every voxel near a reading moves towards the distance that this view finds along the line of
     *  sight, weighted by 1 / sigma_z(z)^2; what was surface and is looked through now moves away
     *  from it.
     *  \throws Error when the view reaches farther from the origin than voxels can be numbered */
    void insert(const SE3& T_world_cam, const DepthView& view);

    using BlockTable = VoxelTable<std::unique_ptr<Block>>;
    /** Keyed by the block's coordinates, voxel coordinates divided by block_size. */
    const BlockTable& blocks() const { return blocks_; }

    std::size_t bytes() const;

  private:
    Block& block(std::uint64_t key);
    void checkReach(const SE3& T_world_cam, double range_m) const;
    std::vector<std::uint64_t> takeBlocksNearReadings(const SE3& T_world_cam,
                                                      const DepthView& view);
    void carve(const SE3& T_world_cam, const DepthView& view);

    double voxel_m_;
    BlockTable blocks_;
    int views_ = 0;
};

}  // namespace rgbd_graphslam
