/** Points spread evenly over a surface. */
#pragma once
#include <Eigen/Core>
#include <functional>

#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** Calls take(place, area) for samples at most spacing_m apart on every triangle, each with the
 *  part of the area (m^2) that it stands for; a surface without triangles gives its vertices, each
 *  with area 1.
 *  \throws Error for a surface too large to be one in meters */
void forEachSurfaceSample(const PlyModel& surface, double spacing_m,
                          const std::function<void(const Eigen::Vector3d&, double)>& take);

}  // namespace rgbd_graphslam
