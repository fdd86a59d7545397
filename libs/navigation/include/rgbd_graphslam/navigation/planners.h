/** Ways from start to goal. */
#pragma once
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "rgbd_graphslam/navigation/drive_options.h"
#include "rgbd_graphslam/navigation/navigation_map.h"
#include "rgbd_graphslam/navigation/robot_body.h"

namespace rgbd_graphslam {

using Route = std::vector<mrpt::math::TPoint2D>;

/** Shortest way of a disc over free cells, by mrpt::nav::PlannerSimple2D; ends with the goal.
 *  \throws Error when there is none */
Route planRoute(const mrpt::maps::COccupancyGridMap2D& grid, const mrpt::math::TPoint2D& start,
                const mrpt::math::TPoint2D& goal, double radius_m);

/** Direction from the start to where the route leaves its surroundings, rad. */
double firstHeading(const mrpt::math::TPose2D& start, const Route& route);

/** Poses that the robot's own kinds of motion can reach one after the other, by
 *  mrpt::nav::PlannerRRT_SE2_TPS (Bellone et al., "TP-space RRT: kinematic path planning of
 *  non-holonomic any-shape vehicles", Int. J. of Advanced Robotic Systems 2015), leg by leg along
 *  the route, which keeps the tree small in large maps. Where a leg has ended without a way on, as
 *  too near to a wall to turn, it and the next are planned as one.
 *  \param config its section PTG_CONFIG holds the kinds of motion
 *  \param cache_folder for MRPT's tables
 *  \return from start to goal, both included \throws Error naming a leg that has no solution from
 * the start on */
std::vector<mrpt::math::TPose2D> planMotion(const NavigationMap& map,
                                            const mrpt::math::TPose2D& start, const Route& route,
                                            const RobotBody& body, const DriveOptions& options,
                                            const mrpt::config::CConfigFileBase& config,
                                            const std::string& cache_folder);

}  // namespace rgbd_graphslam
