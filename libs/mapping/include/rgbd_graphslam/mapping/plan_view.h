/** A picture of the map from above that needs no graphics at all. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** Looks straight down with the ceiling taken off (unless up is a guess): points below 2 m, or
 * below the highest camera if that is higher, x to the right and y up, with the trajectory
 * (orange), some keyframes (blue), loops (red) and a scale bar. Shows what framingOf() frames.
 *  \param inputs upright
 *  \param longer_side_px of the picture
 *  \return CV_8UC3, BGR */
cv::Mat3b planView(const MapInputs& inputs, const PointMap& points, int longer_side_px = 1200);

}  // namespace rgbd_graphslam
