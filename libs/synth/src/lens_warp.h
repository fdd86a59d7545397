/** Pictures through a lens, made of a pinhole camera's. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera_model.h"

namespace rgbd_graphslam::synth {

/** The renderer draws with a pinhole; this camera at the same place sees the same rays in other
 *  pixels. Exact: every pixel looks up its own ray. */
class LensWarp {
  public:
    /** \param camera with or without a lens; all of its view is within 75 degrees of its axis */
    explicit LensWarp(const CameraModel& camera);

    /** What to render with: the camera itself without a lens, else a pinhole that sees all of its
     *  view in finer pixels. */
    const CameraModel& pinhole() const { return pinhole_; }

    /** Between pixels linearly. \param picture of the pinhole, any type \return of the camera */
    cv::Mat smooth(const cv::Mat& picture) const;
    /** The nearest pixel. */
    cv::Mat nearest(const cv::Mat& picture) const;
    /** Between pixels of one plane exactly, across edges the nearest pixel.
     *  \param depth CV_32FC1, m, along the axis, which both cameras share */
    cv::Mat depth(const cv::Mat& depth) const;

  private:
    CameraModel pinhole_;
    cv::Mat1f x_, y_;  // in the pinhole's picture; empty without a lens
};

}  // namespace rgbd_graphslam::synth
