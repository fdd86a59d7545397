/** Known velocity and biases, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** Keeps velocity and biases near known values, such as zero velocity at rest, or a bias until the
 *  motion tells it. */
class MotionStatePrior final : public Factor {
  public:
    /** \param sigma standard deviations of velocity (m/s), gyro bias (rad/s) and accelerometer bias
     *         (m/s^2); positive */
    MotionStatePrior(int keyframe, const MotionState& prior, const Vector9d& sigma)
        : keyframe_(keyframe), prior_(prior), weight_(sigma.cwiseInverse()) {}

    std::vector<StateKey> states() const override { return {motionKey(keyframe_)}; }
    int residualSize() const override { return 9; }
    bool linearize(const StateBlocks& states, Linearization& out) const override {
        out.setResidual(Vector9d(weight_.cwiseProduct(states.motion(0).minus(prior_))));
        out.setJacobian(0, Eigen::Matrix<double, 9, 9>(weight_.asDiagonal()));
        return true;
    }

  private:
    int keyframe_;
    MotionState prior_;
    Vector9d weight_;
};

}  // namespace rgbd_graphslam
