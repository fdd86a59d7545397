/** Readings of all views, averaged in small cells. */
#pragma once
#include <Eigen/Core>
#include <array>

#include "rgbd_graphslam/mapping/surface_samples.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {

/** One view's readings in a voxel. */
struct VoxelReadings {
    struct Cell {
        float weight = 0;
        Eigen::Vector3f offset = Eigen::Vector3f::Zero();  // weighted; as in SurfaceSample
    };
    /** By the lowest bits of a cell's coordinates, x first. */
    std::array<Cell, 8> cells;
    Eigen::Vector3f color = Eigen::Vector3f::Zero();  // weighted; BGR, 0 to 255
    int readings = 0;

    /** \param cell with coordinates as in SurfaceCells */
    void add(const VoxelIndex& cell, const SurfaceSample& sample) {
        Cell& part = cells[(cell.x & 1) | (cell.y & 1) << 1 | (cell.z & 1) << 2];
        part.weight += sample.weight;
        part.offset += sample.offset;
        color += sample.color;
        readings += sample.readings;
    }

    float weight() const {
        float sum = 0;
        for (const Cell& cell : cells) sum += cell.weight;
        return sum;
    }
};

/** Weighted means of readings in cells of half a voxel's edge. */
class SurfaceCells {
  public:
    using Cell = VoxelReadings::Cell;
    using Table = VoxelTable<Cell>;

    explicit SurfaceCells(double cell_m) : cell_m_(cell_m) {}

    double cellSize() const { return cell_m_; }

    /** \param voxel of 2 x 2 x 2 cells */
    void add(const VoxelIndex& voxel, const VoxelReadings& readings);

    /** The same readings in cells of twice the edge. */
    SurfaceCells coarser() const;

    const Table& table() const { return cells_; }
    std::size_t bytes() const { return cells_.bytes(); }

  private:
    double cell_m_;
    Table cells_;
};

}  // namespace rgbd_graphslam
