/** The points of a run. */
#pragma once
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** points.ply of a run, evenly thinned to at most this many; 0 = all.
 *  \throws Error saying how to make it when there is none, or when it is damaged */
PointMap readRunPoints(const std::string& run_folder, std::size_t most = 0);

}  // namespace rgbd_graphslam
