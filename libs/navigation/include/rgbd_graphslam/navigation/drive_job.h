/** What rgbd-drive does. */
#pragma once
#include <mrpt/math/TPose2D.h>

#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Map, way and settings of a drive. */
struct DriveRequest {
    std::string ini;                           // DriveOptions and MRPT's sections
    std::string run_folder;                    // of rgbd-slam or rgbd-map
    std::string out_folder;                    // for path.csv and drive.png; empty: the run folder
    std::optional<mrpt::math::TPose2D> start;  // default: below the first camera, looking its way
    mrpt::math::TPoint2D goal;
    std::string surface, truth;         // true surface and trajectory; both or none
    std::vector<std::string> settings;  // "DriveOptions.key=value"
};

/** How a drive went. */
struct DriveSummary {
    bool arrived = false;
    std::string why_not;  // empty when arrived
    double route_ms = 0, motion_ms = 0;
    std::size_t route_points = 0, motion_poses = 0;
    double driven_m = 0, duration_s = 0;
    std::optional<double> least_clearance_m;  // to the true surface, negative for a collision

    bool good() const { return arrived && least_clearance_m.value_or(1) > 0; }
};

/** Plans, drives and writes path.csv and drive.png.
 *  \throws Error for what cannot be read, planned or written */
DriveSummary runDrive(const DriveRequest& request);

/** As lines "name value" for people. */
std::string toText(const DriveSummary& summary);

}  // namespace rgbd_graphslam
