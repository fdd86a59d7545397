/** The robot's shape. */
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mrpt::config {
class CConfigFileBase;
}

namespace rgbd_graphslam {

/** A prism; x forward, y left, origin between the driven wheels on the floor. */
struct BodyLevel {
    double low_m, high_m;                  // above the floor
    std::vector<Eigen::Vector2d> outline;  // m, in order around it
};

/** Prisms on top of one another. */
using RobotBody = std::vector<BodyLevel>;

/** The levels in section CReactiveNavigationSystem3D, as MRPT reads them.
 *  \throws Error when they are missing or make no shape */
RobotBody readRobotBody(const mrpt::config::CConfigFileBase& config);

/** Of the circle about the origin that holds all levels, m. */
double circumscribedRadius(const RobotBody& body);

/** From a point to an outline, negative within it, m. \param p in the outline's frame */
double signedDistance(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p);

}  // namespace rgbd_graphslam
