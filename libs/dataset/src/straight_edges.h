/** Edges of an image that may show straight lines of the scene. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace rgbd_graphslam {

/** Points along an edge (px), to a fraction of a pixel, in order. */
using EdgePoints = std::vector<cv::Point2f>;

/** Edges that bend by less than 3.5 % of their length, cut out of longer ones where those bend more.
 *  \param gray CV_8UC1 \param shortest_px smallest distance of an edge's ends */
std::vector<EdgePoints> straightEdges(const cv::Mat& gray, double shortest_px);

}  // namespace rgbd_graphslam
