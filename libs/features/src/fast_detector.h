/** FAST-9 corners with their exact score, many pixels at a time. */
#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace rgbd_graphslam {

struct FastCorner {
    int x = 0, y = 0;
    /** The largest threshold for which the pixel is no corner any more: nine neighboring pixels of
     *  the circle are all brighter, or all darker, by at least this. */
    int score = 0;
};

/** Corners (Rosten and Drummond, ECCV 2006) that score highest among their eight neighbors, row by
 *  row.
 *  \param image CV_8UC1
 *  \param area where corners may lie; at least 3 px inside of the image
 *  \param threshold least score */
void detectFast(const cv::Mat& image, const cv::Rect& area, int threshold,
                std::vector<FastCorner>& corners);

}  // namespace rgbd_graphslam
