/** Rectangles in one picture. */
#pragma once
#include <opencv2/core/types.hpp>
#include <vector>

namespace rgbd_graphslam {

/** Where each rectangle lies in the picture. */
struct AtlasLayout {
    cv::Size size;                   // of the picture
    double scale = 1;                // of all rectangles
    std::vector<cv::Point> corners;  // upper left ones, of the scaled rectangles
};

/** Size of a rectangle in the atlas; at least one pixel each way. */
cv::Size scaled(const cv::Size& size, double scale);

/** Packs rectangles in rows of falling height. They are scaled down together until the picture is
 * not larger than most_px each way. \throws Error when they do not fit even then */
AtlasLayout packAtlas(const std::vector<cv::Size>& sizes, int most_px);

}  // namespace rgbd_graphslam
