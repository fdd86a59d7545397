/** Images of a keyframe, small enough to keep all of them. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Most points that keyframePoints() makes. */
inline constexpr std::size_t points_a_keyframe = 8192;

inline constexpr double farthest_painted_m = 6;

/** Colored points of an evenly thinned depth image, in the camera's optical frame and
 *  in random order.
 *  \param color CV_8UC3 (BGR)
 *  \param depth CV_16UC1 of the same size
 *  \param camera of that size */
Vertices keyframePoints(const cv::Mat& color, const cv::Mat& depth, double depth_unit_m,
                        const Camera& camera);

Vertices transformed(const SE3& T_world_cam, const Vertices& points);

/** Depth as colors, near red to far blue, black where there is none (BGR).
 *  \param depth CV_16UC1
 *  \param farthest_m is blue, as is all beyond */
cv::Mat3b paintedDepth(const cv::Mat& depth, double depth_unit_m,
                       double farthest_m = farthest_painted_m);

/** Reduced to at most `width` columns by an integer factor, nearest pixel. */
cv::Mat thinned(const cv::Mat& image, int width);

}  // namespace rgbd_graphslam
