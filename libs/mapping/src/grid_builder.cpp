#include "rgbd_graphslam/mapping/grid_builder.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr int block_size = OccupancyVolume::block_size;
constexpr double enough_of_column = 0.5;

/** Voxel layers [low, high). */
struct Layers {
    int low, high;
    bool contain(int z) const { return z >= low && z < high; }
};

struct Column {
    int largest = std::numeric_limits<int>::min();
    int free = 0;      // voxels
    int evidence = 0;  // sum of their log-odds
    bool floor = false;
};

struct Extent {
    int x0 = 0, y0 = 0, width = 0, height = 0;  // voxels
};

class ColumnMap {
  public:
    ColumnMap(const OccupancyVolume& volume, const MapOptions& options)
        : volume_(volume),
          obstacles_{layer(options.z_min_m), layer(options.z_max_m)},
          floor_{layer(-options.z_min_m), layer(options.z_min_m)},
          extent_(extentOf(volume, {floor_.low, obstacles_.high})) {
        const double megabytes = 1e-6 * sizeof(Column) * extent_.width * extent_.height;
        if (megabytes > options.memory_limit_mb) {
            const double factor = std::sqrt(megabytes / options.memory_limit_mb);
            throw Error("the grid of " + std::to_string(extent_.width) + " x " +
                            std::to_string(extent_.height) + " cells needs " +
                            std::to_string(megabytes) + " MB",
                        "set grid_resolution_m to " + std::to_string(volume.resolution() * factor));
        }
        columns_.resize(static_cast<std::size_t>(extent_.width) * extent_.height);
        for (const auto& [key, block] : volume.blocks().entries()) add(voxelOfKey(key), *block);
    }

    const Extent& extent() const { return extent_; }

    /** Nothing where unknown. */
    std::optional<int> logOdds(int x, int y) const {
        const Column& column = columns_[static_cast<std::size_t>(y) * extent_.width + x];
        if (column.largest >= 0) return column.largest;
        const int layers = obstacles_.high - obstacles_.low;
        if (column.floor) return OccupancyVolume::lowest;
        if (column.free < enough_of_column * layers) return std::nullopt;
        return std::max<int>(column.evidence, OccupancyVolume::lowest);
    }

  private:
    int layer(double z_m) const {
        return static_cast<int>(std::lround(z_m / volume_.resolution()));
    }

    static Extent extentOf(const OccupancyVolume& volume, const Layers& layers) {
        constexpr int far = std::numeric_limits<int>::max();
        VoxelIndex low{far, far, 0}, high{-far, -far, 0};
        for (const auto& entry : volume.blocks().entries()) {
            const VoxelIndex block = voxelOfKey(entry.key);
            if ((block.z + 1) * block_size <= layers.low || block.z * block_size >= layers.high)
                continue;
            low = {std::min(low.x, block.x), std::min(low.y, block.y), 0};
            high = {std::max(high.x, block.x + 1), std::max(high.y, block.y + 1), 0};
        }
        if (low.x >= high.x) return {};
        return {low.x * block_size, low.y * block_size, (high.x - low.x) * block_size,
                (high.y - low.y) * block_size};
    }

    void add(const VoxelIndex& index, const OccupancyVolume::Block& block) {
        for (int z = 0; z < block_size; ++z) {
            const int layer = index.z * block_size + z;
            const bool obstacle = obstacles_.contain(layer), floor = floor_.contain(layer);
            if (!obstacle && !floor) continue;
            for (int y = 0; y < block_size; ++y) {
                for (int x = 0; x < block_size; ++x) {
                    const auto value = block.log_odds[OccupancyVolume::Block::indexOf(x, y, z)];
                    if (value == OccupancyVolume::unknown) continue;
                    Column& column = at(index.x * block_size + x, index.y * block_size + y);
                    if (floor) column.floor |= value >= 0;
                    if (!obstacle) continue;
                    column.largest = std::max<int>(column.largest, value);
                    if (value >= 0) continue;
                    ++column.free;
                    column.evidence += value;
                }
            }
        }
    }

    Column& at(int x, int y) {
        return columns_[static_cast<std::size_t>(y - extent_.y0) * extent_.width +
                        (x - extent_.x0)];
    }

    const OccupancyVolume& volume_;
    Layers obstacles_, floor_;
    Extent extent_;
    std::vector<Column> columns_;
};

}  // namespace

void buildGrid(const OccupancyVolume& volume, const MapOptions& options,
               mrpt::maps::COccupancyGridMap2D& grid) {
    if (options.z_min_m >= options.z_max_m) {
        throw Error("z_min_m = " + std::to_string(options.z_min_m) +
                        " is not below z_max_m = " + std::to_string(options.z_max_m),
                    "give obstacles a range of heights");
    }
    const ColumnMap columns(volume, options);
    const Extent& extent = columns.extent();
    const double r = volume.resolution();
    // Where nothing was seen, one unknown cell stands for the map.
    grid.setSize(r * extent.x0, r * (extent.x0 + std::max(extent.width, 1)), r * extent.y0,
                 r * (extent.y0 + std::max(extent.height, 1)), r, 0.5f);
    for (int y = 0; y < extent.height; ++y) {
        for (int x = 0; x < extent.width; ++x) {
            const auto value = columns.logOdds(x, y);
            if (!value) continue;
            const double free = 1 / (1 + std::exp(OccupancyVolume::log_odds_step * *value));
            grid.setCell(x, y, static_cast<float>(free));
        }
    }
}

}  // namespace rgbd_graphslam
