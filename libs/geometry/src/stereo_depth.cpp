#include "rgbd_graphslam/geometry/stereo_depth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/calib3d.hpp>

namespace rgbd_graphslam {
namespace {

constexpr int window_px = 5;
/** Penalties of the matcher for disparities that change by one pixel and by more, for gray values
 *  that differ by as much over the whole window. */
constexpr int small_step = 8, large_step = 32;
constexpr int largest_left_right_difference_px = 1, prefilter_cap = 31, uniqueness_percent = 10;
/** Smaller patches of one disparity are noise. */
constexpr int speckle_px = 100, speckle_step_px = 2;
/** A block of disparities that the matcher takes at once, and its fixed-point scale. */
constexpr int disparity_block = 16;
constexpr double sub_steps = 16;
constexpr double farthest_unit_count = 60000;

cv::Ptr<cv::StereoSGBM> makeMatcher(int disparities) {
    const int area = window_px * window_px;
    return cv::StereoSGBM::create(0, disparities, window_px, small_step * area, large_step * area,
                                  largest_left_right_difference_px, prefilter_cap,
                                  uniqueness_percent, speckle_px, speckle_step_px,
                                  cv::StereoSGBM::MODE_SGBM_3WAY);
}

/** \param disparity CV_16SC1, sixteenths of a pixel, not positive where none was found */
cv::Mat depthOf(const cv::Mat& disparity, double disparity_m_px, double unit_m) {
    cv::Mat depth(disparity.size(), CV_16UC1);
    const double numerator = sub_steps * disparity_m_px / unit_m;
    for (int y = 0; y < depth.rows; ++y) {
        const auto* d = disparity.ptr<std::int16_t>(y);
        auto* z = depth.ptr<std::uint16_t>(y);
        for (int x = 0; x < depth.cols; ++x) {
            const double reading = d[x] > 0 ? std::round(numerator / d[x]) : 0;
            z[x] = reading <= 65535 ? static_cast<std::uint16_t>(reading) : 0;
        }
    }
    return depth;
}

/** The matcher leaves out as many columns on the left as it looks for disparities. */
cv::Mat padded(const cv::Mat& image, int columns) {
    cv::Mat wide;
    cv::copyMakeBorder(image, wide, 0, 0, columns, 0, cv::BORDER_REPLICATE);
    return wide;
}

}  // namespace

int largestDisparity(int width, double disparity_m_px, double nearest_m) {
    constexpr int most_px = 256;
    const double wanted = std::ceil(disparity_m_px / nearest_m);
    return static_cast<int>(std::clamp<double>(wanted, 1, std::min(most_px, width / 3)));
}

double stereoDepthUnit(double disparity_m_px) {
    return std::max(0.001, disparity_m_px / farthest_unit_count);
}

RgbdImage withDenseDepth(RgbdImage pair) {
    const int wanted = largestDisparity(pair.gray.cols, pair.disparity_m_px);
    const int disparities = (wanted + disparity_block - 1) / disparity_block * disparity_block;
    cv::Mat disparity;
    makeMatcher(disparities)
        ->compute(padded(pair.gray, disparities), padded(pair.right, disparities), disparity);
    disparity = disparity.colRange(disparities, disparity.cols);
    pair.depth_unit_m = stereoDepthUnit(pair.disparity_m_px);
    pair.depth = depthOf(disparity, pair.disparity_m_px, pair.depth_unit_m);
    return pair;
}

}  // namespace rgbd_graphslam
