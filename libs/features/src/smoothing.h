/** Smoothing of the images that descriptors are read from. */
#pragma once
#include <opencv2/core.hpp>

namespace rgbd_graphslam {

/** Pixels on each side that smooth() leaves as they are. */
constexpr int smoothing_radius = 2;

/** Binomial weights (1 4 6 4 1)/16 along both axes, rounded once: cv::GaussianBlur() of 5x5 pixels
 *  to the bit, in a third of its time.
 *  \param image 8-bit gray
 *  \param smooth of the same size; its border is not written */
void smooth(const cv::Mat& image, cv::Mat& smooth);

}  // namespace rgbd_graphslam
