/** Laser scans beside a camera, in the grid. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace rgbd_graphslam {

/** Collects the scans of a run's rawlogs from where the robot moved, and marks in the grid what
 * they met at the heights of obstacles: glass and thin legs, which a depth camera looks through. */
class ScanLayer {
  public:
    /** Keeps the entry if it is a scan from a place or direction that none was kept from.
     *  \param trajectory of the camera, upright */
    void note(const mrpt::obs::CObservation& entry, const Trajectory& trajectory);

    /** The camera's place on the robot, for the scans noted since the last call. */
    void place(const SE3& T_base_cam);

    /** Marks the ends of beams in the grid where their heights are obstacles', see
     *  MapOptions::z_min_m; warns where none are. \return scans that were entered */
    std::size_t mergeInto(mrpt::maps::COccupancyGridMap2D& grid, const MapOptions& options) const;

  private:
    struct Scan {
        mrpt::obs::CObservation2DRangeScan::Ptr observation;
        SE3 T_up_cam;
        std::optional<SE3> T_base_cam = {};

        SE3 T_up_laser() const;
    };

    std::vector<Scan> scans_;
};

}  // namespace rgbd_graphslam
