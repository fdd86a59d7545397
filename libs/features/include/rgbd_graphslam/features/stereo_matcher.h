/** Disparities of single points of a rectified stereo pair. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

namespace rgbd_graphslam {

/** Finds points of the left image in the same row of the right one: the best of all whole
 * disparities by the sum of absolute differences of horizontal gradients, kept when no other is
 * nearly as good and the way back leads to the same point, then refined by least squares over gray
 * values with a disparity that changes linearly over the window, since floors and walls are seen at
 * an angle (Lucas and Kanade's alignment as in Baker and Matthews, "Lucas-Kanade 20 years on", IJCV
 * 2004). */
class StereoMatcher {
  public:
    /** \param left, right CV_8UC1 of one size; shared
     *  \param largest_disparity px, at least 1 */
    StereoMatcher(const cv::Mat& left, const cv::Mat& right, int largest_disparity);

    /** \param u, v pixel of the left image
     *  \return disparity u - u_right (px, > 0) with an error of 0.1 to 0.3 px; nothing where the
     *          point is near the border, hidden from the right camera, not told from others in its
     *          row, or at infinity */
    std::optional<float> disparityAt(float u, float v) const;

  private:
    std::optional<int> searchRow(int x, int y) const;
    int bestRight(int x, int y, int& second) const;
    int bestLeft(int x_right, int y) const;
    std::optional<float> refine(float u, float v, float disparity) const;

    cv::Mat left_, right_;
    cv::Mat left_edges_, right_edges_;
    int largest_disparity_;
};

}  // namespace rgbd_graphslam
