/** Where the surface runs, from the readings of all views together. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "rgbd_graphslam/mapping/surface_samples.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {

/** Points p with normal.dot(p) == offset_m. */
struct Plane {
    Eigen::Vector3d normal;  // unit vector
    double offset_m = 0;

    /** Whether it runs through a cube. */
    bool crosses(const Eigen::Vector3d& center, double edge_m) const {
        return std::abs(normal.dot(center) - offset_m) <= edge_m / 2 * normal.cwiseAbs().sum();
    }
};

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

/** Weighted means of readings in cells of half a voxel's edge. A single reading errs by
 * centimetres; the plane through what all views read about a place does not, which tells a voxel
 * that holds surface from one beside it that noise spilled into. */
class SurfaceCells {
  public:
    explicit SurfaceCells(double voxel_m) : voxel_m_(voxel_m) {}

    double cellSize() const { return voxel_m_ / 2; }

    void add(const VoxelIndex& voxel, const VoxelReadings& readings);

    /** The plane fitted by moving least squares (Levin, "Mesh-independent surface interpolation",
     *  2003) to the cells around the mean of a voxel's readings. Nothing where the readings do not
     *  lie flat, as on thin and small things and at corners. */
    std::optional<Plane> planeAt(const VoxelIndex& voxel) const;

    std::size_t bytes() const { return cells_.bytes(); }

  private:
    using Cell = VoxelReadings::Cell;
    /** From the origin of coordinates, in cells. */
    static Eigen::Vector3d meanOf(const VoxelIndex& index, const Cell& cell);
    /** \param middle, radius in cells */
    std::optional<Plane> planeAround(const Eigen::Vector3d& middle, double radius) const;
    struct WeightedMean {
        Eigen::Vector3d mean;  // as by meanOf
        double weight;         // 0 without readings
    };
    WeightedMean meanIn(const VoxelIndex& voxel) const;

    double voxel_m_;
    VoxelTable<Cell> cells_;
};

}  // namespace rgbd_graphslam
