/** The position of a sensor in the world, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** What GPS measures: where its antenna is. The residual is measured - predicted in the world's
 *  axes, over the standard deviations. */
class PositionMeasurement final : public Factor {
  public:
    /** \param position of the antenna in the world, m
     *  \param sigma standard deviations along the world's axes, m; positive
     *  \param lever_arm the antenna in the body's frame, m */
    PositionMeasurement(int keyframe, const Eigen::Vector3d& position, const Eigen::Vector3d& sigma,
                        const Eigen::Vector3d& lever_arm, const RobustKernel& kernel = {})
        : keyframe_(keyframe),
          position_(position),
          weight_(sigma.cwiseInverse()),
          lever_arm_(lever_arm),
          kernel_(kernel) {}

    std::vector<StateKey> states() const override { return {poseKey(keyframe_)}; }
    int residualSize() const override { return 3; }
    RobustKernel kernel() const override { return kernel_; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int keyframe_;
    Eigen::Vector3d position_, weight_, lever_arm_;
    RobustKernel kernel_;
};

}  // namespace rgbd_graphslam
