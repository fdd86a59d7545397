/** Laser scans in an occupancy grid. */
#pragma once
#include <vector>

#include "rgbd_graphslam/laser/planar_scan.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace rgbd_graphslam {

/** A scan's beams in the world's plane, m. */
struct ScanBeams {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    std::vector<Eigen::Vector2d> ends;
};

/** Log-odds of cells that beams passed and ended in (Moravec and Elfes, 1985). A cell that one beam
 *  of a scan ends in is not counted as passed by another beam of that scan. */
class ScanGrid {
  public:
    explicit ScanGrid(double resolution_m);

    void insert(const ScanBeams& beams);

    bool empty() const { return scans_.empty(); }

    /** \param[out] grid resized to what was seen
     *  \throws Error when it would need more than `memory_limit_mb` */
    void build(mrpt::maps::COccupancyGridMap2D& grid, int memory_limit_mb) const;

    /** Makes cells occupied where scans say so, and unknown ones free where scans passed; what the
     *  grid has as occupied stays. The grid grows to hold both. */
    void mergeInto(mrpt::maps::COccupancyGridMap2D& grid, int memory_limit_mb) const;

  private:
    double resolution_m_;
    std::vector<ScanBeams> scans_;
};

}  // namespace rgbd_graphslam
