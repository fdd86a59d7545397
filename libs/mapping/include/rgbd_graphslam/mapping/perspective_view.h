/** A picture of the map in perspective that needs no graphics at all. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** Looks down at the map from one of its longer sides, without what is above people's heads: points
 *  in their colors, floor lines with distances, trajectory, some keyframes, loops and a scale bar,
 *  which holds for the middle of the map.
 *  \param inputs upright
 *  \param spacing_m between neighboring points
 *  \return CV_8UC3, BGR */
cv::Mat3b perspectiveView(const MapInputs& inputs, const PointMap& points, double spacing_m,
                          const cv::Size& size_px = {1200, 760});

}  // namespace rgbd_graphslam
