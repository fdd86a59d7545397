/** Dirt on the color camera's lens. */
#pragma once
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/synth/lens_effect.h"

namespace rgbd_graphslam::synth {

/** Ragged specks that hide the scene and smears that blur it, fixed to the picture. */
class LensDirt : public LensEffect {
  public:
    explicit LensDirt(std::uint64_t seed);
    void spoil(cv::Mat& picture, const SE3& T_world_cam, const Camera& camera) const override;
    void mark(cv::Mat& mask, const SE3& T_world_cam, const Camera& camera) const override;

  private:
    cv::Mat specks_, smears_;  // CV_32FC1, how much of the scene they take, for any size of picture
};

}  // namespace rgbd_graphslam::synth
