/** One color image with depth registered to it, or with the right image of a stereo pair. */
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>

namespace rgbd_graphslam {

/** Images of one size; cheap to copy (pixels are shared). */
struct RgbdImage {
    double stamp_s = 0;
    cv::Mat gray;   // CV_8UC1; may be empty where only color is asked for
    cv::Mat color;  // CV_8UC3, BGR; may be empty
    cv::Mat depth;  // CV_16UC1, in units of depth_unit_m along the optical axis; 0 = no reading
    cv::Mat mask;   // CV_8UC1, 0 = ignored: the robot's own arm, dirt; empty = none is
    double depth_unit_m = 0.001;
    /** CV_8UC1, of a rectified stereo pair whose left image is `gray`: depth of keypoints comes
     * from the pair, and `depth` may be empty. Empty for RGB-D cameras. */
    cv::Mat right;
    /** Of the pair: depth times disparity, m px. */
    double disparity_m_px = 0;
    /** Keeps alive whatever owns the pixels, e.g. an MRPT observation. */
    std::shared_ptr<const void> owner;
};

}  // namespace rgbd_graphslam
