/** Laying a trajectory over positions. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A point of the map and where it is on the tangent plane, m. */
struct PlacePair {
    Eigen::Vector3d map, enu;
    double sigma_m = 1;
};

/** The motion about z and in position (four degrees of freedom; both frames have z up) that lays
 *  the map's points over the others, least squares of robust weights. Nothing where the points lie
 *  within `least_extent_m`: the heading is not known then. */
std::optional<SE3> alignLevel(const std::vector<PlacePair>& pairs, double least_extent_m = 5);

}  // namespace rgbd_graphslam
