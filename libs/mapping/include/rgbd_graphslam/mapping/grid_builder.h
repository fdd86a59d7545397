/** The floor plan of an occupancy volume. */
#pragma once
#include "rgbd_graphslam/mapping/map_options.h"
#include "rgbd_graphslam/mapping/occupancy_volume.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace rgbd_graphslam {

/** Looks at the column above each cell, in a volume whose floor is z = 0 with z up. One occupied
 * voxel between z_min_m and z_max_m makes the cell an obstacle, of the largest log-odds there. It
 * is free when nothing there is occupied and either the floor below was seen or at least half of
 * the column was looked through, which add up as evidence; unknown otherwise. Cells have the
 * voxels' edge. \param[out] grid resized to what was seen \throws Error when z_min_m >= z_max_m or
 * the grid would need more than memory_limit_mb */
void buildGrid(const OccupancyVolume& volume, const MapOptions& options,
               mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace rgbd_graphslam
