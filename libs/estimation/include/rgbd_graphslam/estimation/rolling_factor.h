/** Wheels stay on the ground, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** A robot on wheels moves within the plane that its base is in, whichever plane that is: on ramps
 *  as well, unlike with a planar prior. The residual is the way of the base along its own z axis,
 *  as at the first keyframe (the non-holonomic constraint of land vehicles; Dissanayake et al.,
 *  "The aiding of a low-cost strapdown inertial measurement unit using vehicle model constraints",
 *  2001). */
class RollingFactor final : public Factor {
  public:
    /** \param sigma_m standard deviation, positive
     *  \param T_base_body as for WheelFactor
     *  \param kernel for steps and thresholds */
    RollingFactor(int from, int to, double sigma_m, const SE3& T_base_body = {},
                  const RobustKernel& kernel = {})
        : from_(from), to_(to), sigma_m_(sigma_m), T_base_body_(T_base_body), kernel_(kernel) {}

    std::vector<StateKey> states() const override { return {poseKey(from_), poseKey(to_)}; }
    int residualSize() const override { return 1; }
    RobustKernel kernel() const override { return kernel_; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int from_, to_;
    double sigma_m_;
    SE3 T_base_body_;
    RobustKernel kernel_;
};

}  // namespace rgbd_graphslam
