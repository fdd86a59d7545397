/** Outlines in color and depth images, made to be compared. */
#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace rgbd_graphslam {

/** Where color has more of an edge than around; mean 0, standard deviation 1.
 *  \param color CV_8UC3 \param width of the result, at most that of the image */
cv::Mat1f edgeContrast(const cv::Mat& color, int width);

/** Outlines of things: where depth jumps, at the nearer side, in pixels of the depth image.
 *  \param depth CV_16UC1, 0 = no reading
 *  \param most keep about so many, evenly chosen */
std::vector<Eigen::Vector2f> depthOutlines(const cv::Mat& depth, std::size_t most);

/** Where depth may belong in the color image. */
struct Placement {
    /** About the center of the image. */
    double scale = 1;
    /** After that, in pixels of the reduced image. */
    cv::Point2d shift;
};

/** How well outlines, placed so and then moved by up to `reach` pixels of the reduced image, fall
 * on edges of color: about standard deviations from what a random place would give. \param
 * contrast see edgeContrast \param outlines in pixels of images of this width \return (2 reach + 1)
 * x (2 reach + 1), row = motion down */
cv::Mat1d agreementAt(const cv::Mat1f& contrast, const std::vector<Eigen::Vector2f>& outlines,
                      int width, const Placement& placement, int reach);

}  // namespace rgbd_graphslam
