/** One color image with depth registered to it. */
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
    /** Keeps alive whatever owns the pixels, e.g. an MRPT observation. */
    std::shared_ptr<const void> owner;
};

}  // namespace rgbd_graphslam
