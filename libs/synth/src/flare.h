/** A bright lamp in a lens. */
#pragma once
#include <vector>

#include "rgbd_graphslam/synth/lens_effect.h"

namespace rgbd_graphslam::synth {

/** A glow about each lamp and ghosts of it on the line through the picture's center, which move the
 *  other way as the camera turns (Hullin et al., "Physically-based real-time lens flare rendering",
 *  SIGGRAPH 2011, has the optics; these are discs). Nothing stands before the lamps. */
class LensFlare : public LensEffect {
  public:
    explicit LensFlare(std::vector<Eigen::Vector3d> lamps) : lamps_(std::move(lamps)) {}
    void spoil(cv::Mat& picture, const SE3& T_world_cam, const Camera& camera) const override;
    /** The ghosts; the glow is about a thing of the world. */
    void mark(cv::Mat& mask, const SE3& T_world_cam, const Camera& camera) const override;

  private:
    std::vector<Eigen::Vector3d> lamps_;
};

}  // namespace rgbd_graphslam::synth
