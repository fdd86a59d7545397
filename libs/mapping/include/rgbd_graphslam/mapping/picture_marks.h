/** Texts and scales in pictures of a map. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/mapping/scene_colors.h"
#include "rgbd_graphslam/mapping/view_scale.h"

namespace rgbd_graphslam {

/** In OpenCV's order of channels. */
cv::Scalar bgrOf(const Rgba& color);

/** A bar of a round length in the bottom left corner. \param picture BGR */
void drawScaleBar(cv::Mat3b& picture, double m_per_px);

/** Texts with their middles at the labels' places. */
void drawLabels(cv::Mat3b& picture, const std::vector<SceneLabel>& labels);

}  // namespace rgbd_graphslam
