/** A robot that drives by MRPT's reactive navigation, in simulation. */
#pragma once
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "rgbd_graphslam/navigation/drive_options.h"
#include "rgbd_graphslam/navigation/navigation_map.h"

namespace rgbd_graphslam {

/** The robot at one step of the simulation. */
struct DrivenPose {
    double time_s;  // of the simulation
    mrpt::math::TPose2D pose;
    double speed_m_s, turn_rad_s;
};

/** A driven path, and why it ended. */
struct Drive {
    bool arrived = false;
    std::string why_not;  // empty when arrived
    std::vector<DrivenPose> path;

    double length_m() const;
    double duration_s() const { return path.empty() ? 0 : path.back().time_s; }
};

/** Follows the waypoints with mrpt::nav::CReactiveNavigationSystem3D on a two-wheeled robot without
 *  slip, after turning on the spot to first_heading_rad: reactive navigation looks ahead, and
 * dithers when all the way lies behind. Its sensor sees the map's obstacles and borders around it,
 * in every direction. \param waypoints the last is the goal \param config MRPT's sections of
 * drive.ini \param cache_folder for MRPT's tables \throws Error when MRPT refuses the settings */
Drive driveAlong(const NavigationMap& map, const mrpt::math::TPose2D& start,
                 double first_heading_rad, const std::vector<mrpt::math::TPoint2D>& waypoints,
                 const DriveOptions& options, const mrpt::config::CConfigFileBase& config,
                 const std::string& cache_folder);

}  // namespace rgbd_graphslam
