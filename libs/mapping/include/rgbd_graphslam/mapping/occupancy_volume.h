/** Which space is occupied, free or unknown. */
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "rgbd_graphslam/mapping/surface_cells.h"
#include "rgbd_graphslam/mapping/surface_samples.h"

namespace rgbd_graphslam {

/** A cube of voxels aligned to its size, a power of two. */
struct VoxelCube {
    VoxelIndex corner;  // the lower one
    int size;           // voxels along an edge
};

/** Log-odds of occupancy in voxels, with the update rule of OctoMap (Hornung et al., "OctoMap: an
 *  efficient probabilistic 3D mapping framework based on octrees", Autonomous Robots 2013). Voxels
 *  are kept in blocks aligned to the octree's nodes of the same size, which makes an update a
 *  handful of array operations; octree_builder.h makes the octree of it. */
class OccupancyVolume {
  public:
    static constexpr int block_size = 8;
    /** Log-odds are whole multiples of this. */
    static constexpr float log_odds_step = 0.05f;
    /** OctoMap's default model in those steps: hit 0.85, miss -0.4, limits -2 and 3.5. */
    static constexpr int hit = 17, miss = -8, lowest = -40, highest = 70;
    static constexpr std::int8_t unknown = -128;

    struct Block {
        std::array<std::int8_t, block_size * block_size * block_size> log_odds;
        Block() { log_odds.fill(unknown); }
        /** \param x,y,z from 0 to block_size - 1 */
        static int indexOf(int x, int y, int z) { return (z * block_size + y) * block_size + x; }
    };

    /** \param hit_share see MapOptions
     *  \throws Error when the resolution is not positive */
    OccupancyVolume(double resolution_m, double hit_share);

    /** Marks what a view sees: leaves with enough readings as hit, those before the readings as
     *  missed. A leaf is missed only when every reading in its image lies behind it, so that a
     *  surface seen at a grazing angle is not carved away.
     *  \throws Error when the view reaches beyond what an octree of this resolution can hold */
    void insert(const SE3& T_world_cam, const DepthView& view);

    /** Makes unknown again what is occupied by noise alone: voxels with readings in them which the
     *  surface, as all views together show it, does not run through. To be called when all views
     * are in. */
    void removeNoiseVoxels();

    /** In steps; nothing where unknown. */
    std::optional<int> logOdds(const VoxelIndex& voxel) const;
    std::optional<int> logOdds(const Eigen::Vector3d& point_m) const;

    /** BGR of an occupied voxel, nothing where no reading fell. */
    std::optional<Eigen::Vector3f> color(const VoxelIndex& voxel) const;

    using BlockTable = VoxelTable<std::unique_ptr<Block>>;
    /** Keyed by the block's coordinates, voxel coordinates divided by block_size. */
    const BlockTable& blocks() const { return blocks_; }

    double resolution() const { return resolution_m_; }
    std::size_t bytes() const;

  private:
    void checkReach(const SE3& T_world_cam, double range_m) const;
    Block& block(const VoxelIndex& voxel);
    void addMiss(const VoxelCube& cube);
    void addHits(const SE3& T_world_cam, const DepthView& view);
    void sortReadings(const SE3& T_world_cam, const DepthView& view, int step);

    double resolution_m_;
    double hit_share_;
    BlockTable blocks_;
    struct ColorSum {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        float weight = 0;
    };
    VoxelTable<ColorSum> colors_;
    SurfaceCells cells_;
    VoxelTable<VoxelReadings> frame_;  // of one view; kept to reuse its memory
};

}  // namespace rgbd_graphslam
