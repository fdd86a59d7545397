/** What a lens adds to pictures. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam::synth {

/** Spoils the color picture before the sensor takes it; depth is measured through another lens. */
class LensEffect {
  public:
    virtual ~LensEffect() = default;
    /** \param picture CV_32FC3, levels 0..255 of the exposed scene */
    virtual void spoil(cv::Mat& picture, const SE3& T_world_cam, const Camera& camera) const = 0;
    /** Sets pixels to 255 that show the lens more than the scene. \param mask CV_8UC1 */
    virtual void mark(cv::Mat& mask, const SE3& T_world_cam, const Camera& camera) const = 0;
};

}  // namespace rgbd_graphslam::synth
