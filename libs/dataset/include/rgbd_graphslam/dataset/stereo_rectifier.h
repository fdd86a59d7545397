/** Rectification of stereo pairs. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** Turns both images of a stereo camera, of any lens model, into those of two equal pinhole cameras
 *  side by side, so that a point is in the same row of both (Fusiello, Trucco and Verri, "A compact
 *  algorithm for rectification of stereo pairs", 2000): the x axis along the baseline, z as near as
 *  possible to both optical axes, the focal length the mean of both, the image cut to what both
 *  show. Of cameras that are so already, images stay as they are. */
class StereoRectifier {
  public:
    /** \param T_left_right pose of the right optical frame in the left one's
     *  \throws Error when the right camera is not to the right, or both have hardly any view in
     *          common */
    StereoRectifier(const Intrinsics& left, const Intrinsics& right, const SE3& T_left_right);

    /** Of both rectified images. */
    const Intrinsics& camera() const { return camera_; }
    /** Pose of the rectified left optical frame in the left one's: a rotation. */
    const SE3& T_left_rectified() const { return T_left_rectified_; }
    /** Focal length times baseline, m px: depth times disparity. */
    double disparityInMeterPixels() const { return camera_.fx * baseline_m_; }

    /** \param image of the left camera's size, any type; shared where nothing changes */
    cv::Mat left(const cv::Mat& image) const { return left_.apply(image); }
    cv::Mat right(const cv::Mat& image) const { return right_.apply(image); }

  private:
    /** Where the pixels of a rectified image come from; empty: from the same place. */
    struct Map {
        cv::Mat x, y;
        cv::Mat apply(const cv::Mat& image) const;
    };
    struct Side;

    Intrinsics camera_;
    SE3 T_left_rectified_;
    double baseline_m_ = 0;
    Map left_, right_;
};

}  // namespace rgbd_graphslam
