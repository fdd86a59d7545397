/** How many occupied cells of an occupancy grid are right. */
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/mover_boxes.h"
#include "rgbd_graphslam/evaluation/report.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/metrics/alignment.h"

namespace rgbd_graphslam {

/** How an occupancy grid is compared with a true surface. */
struct GridAccuracyOptions {
    /** Maps the map's coordinates to the surface's. */
    Similarity alignment;
    /** Obstacles are what lies between these heights of the surface's frame. */
    double min_z_m = 0.1, max_z_m = 1.5;
    /** A cell is right with an obstacle so near to its middle, seen from above. */
    double tolerance_m = 0.1;
    /** Where things moved, in the surface's frame; may be null. */
    const MoverWays* movers = nullptr;
};

/** Occupied cells of a grid, and those without an obstacle. */
struct GridAccuracy {
    std::size_t occupied = 0;  // cells
    std::size_t wrong = 0;     // of them, without an obstacle near
    /** Wrong ones where a mover has been; nothing when it is not told. */
    std::optional<std::size_t> on_movers_ways;
};

/** Middles of the occupied cells of a grid that map servers of ROS read, in the map's frame at
 *  z = 0. \param yaml names the picture; black is occupied
 *  \throws Error naming the file that cannot be read */
std::vector<Eigen::Vector3d> occupiedCells(const std::string& yaml);

/** \throws Error when the surface has no obstacle between the heights */
GridAccuracy evaluateGrid(const std::vector<Eigen::Vector3d>& occupied, const PlyModel& surface,
                          const GridAccuracyOptions& options = {});

Report reportOf(const std::string& grid, const GridAccuracy& accuracy);

}  // namespace rgbd_graphslam
