/** What is kept of a drive. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "rgbd_graphslam/navigation/planners.h"
#include "rgbd_graphslam/navigation/simulated_drive.h"

namespace rgbd_graphslam {

/** "time_s,x_m,y_m,phi_rad,speed_m_s,turn_rad_s[,clearance_m]" and a line for each pose.
 *  \param clearances_m one a pose, or none */
std::string pathCsv(const Drive& drive, const std::vector<double>& clearances_m);

/** The grid (free light, unknown gray, occupied dark) with the obstacles' colors, the route
 *  (dotted, blue), the planned motion (green), the driven path (orange) and the body at its start
 *  and end. North is +y. */
cv::Mat3b drivePicture(const NavigationMap& map, const Route& route,
                       const std::vector<mrpt::math::TPose2D>& motion, const Drive& drive,
                       const RobotBody& body);

}  // namespace rgbd_graphslam
