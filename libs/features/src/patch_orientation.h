/** Which way a corner points. */
#pragma once
#include <opencv2/core/mat.hpp>

namespace rgbd_graphslam {

/** Direction from a pixel to the centroid of the gray values in the disc of radius
 *  orb_patch_radius around it (Rosin, "Measuring corner properties", CVIU 1999), rad.
 *  \param image CV_8UC1; the disc and one pixel more lie within it */
float patchOrientation(const cv::Mat& image, int x, int y);

}  // namespace rgbd_graphslam
