/** The maps of a run, as a robot uses them. */
#pragma once
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/point_fusion.h"
#include "rgbd_graphslam/navigation/drive_options.h"

namespace rgbd_graphslam {

/** In the frame of the run: z up, floor at z = 0. */
struct NavigationMap {
    mrpt::maps::COccupancyGridMap2D grid;
    PointMap obstacles;  // colored, above the floor, thinned out to one a voxel
    /** Cells where free space ends, at obstacles and at what was never seen. */
    std::vector<mrpt::math::TPoint2D> borders;
};

/** Reads an MRPT grid as `.gridmap` or `.gridmap.gz`.
 *  \throws Error when it is missing, cut off, or no grid */
mrpt::maps::COccupancyGridMap2D loadGrid(const std::string& path);

/** Reads grid.gridmap.gz and points.ply. \param height_m points above are out of the robot's way
 *  \throws Error when one is missing or damaged */
NavigationMap loadNavigationMap(const std::string& run_folder, const DriveOptions& options,
                                double height_m);

/** Cells that are not free beside one that is, by their centers. */
std::vector<mrpt::math::TPoint2D> bordersOf(const mrpt::maps::COccupancyGridMap2D& grid);

/** \throws Error naming the nearest place that would do, when a disc at (x, y) is not wholly over
 *          free cells. \param what "start" or "goal" */
void requireFree(const mrpt::maps::COccupancyGridMap2D& grid, const mrpt::math::TPoint2D& place,
                 double radius_m, const std::string& what);

}  // namespace rgbd_graphslam
