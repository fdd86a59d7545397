#include "rgbd_graphslam/mapping/surface_cells.h"

namespace rgbd_graphslam {

void SurfaceCells::add(const VoxelIndex& voxel, const VoxelReadings& readings) {
    for (int i = 0; i < 8; ++i) {
        const Cell& more = readings.cells[i];
        if (more.weight <= 0) continue;
        Cell& cell = cells_[voxelKey(
            {2 * voxel.x + (i & 1), 2 * voxel.y + (i >> 1 & 1), 2 * voxel.z + (i >> 2)})];
        cell.weight += more.weight;
        cell.offset += more.offset;
    }
}

SurfaceCells SurfaceCells::coarser() const {
    SurfaceCells result(2 * cell_m_);
    for (const auto& [key, cell] : cells_.entries()) {
        const VoxelIndex fine = voxelOfKey(key);
        const Eigen::Vector3f corner(fine.x & 1, fine.y & 1, fine.z & 1);
        Cell& sum = result.cells_[voxelKey({fine.x >> 1, fine.y >> 1, fine.z >> 1})];
        sum.weight += cell.weight;
        sum.offset += 0.5f * (cell.weight * corner + cell.offset);
    }
    return result;
}

}  // namespace rgbd_graphslam
