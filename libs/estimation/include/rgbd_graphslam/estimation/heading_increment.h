/** A gyroscope's turn between two keyframes, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** The yaw of a level robot between two keyframes, by a gyroscope whose bias about z is the third
 *  number of the gyro bias of one motion state, shared by all increments of a recording. */
class HeadingIncrement final : public Factor {
  public:
    /** \param yaw_rad integrated rate, bias included
     *  \param duration_s over which it was integrated
     *  \param sigma_rad positive
     *  \param bias_keyframe whose motion state holds the bias */
    HeadingIncrement(int from, int to, double yaw_rad, double duration_s, double sigma_rad,
                     int bias_keyframe)
        : from_(from),
          to_(to),
          bias_keyframe_(bias_keyframe),
          yaw_rad_(yaw_rad),
          duration_s_(duration_s),
          weight_(1 / sigma_rad) {}

    std::vector<StateKey> states() const override {
        return {poseKey(from_), poseKey(to_), motionKey(bias_keyframe_)};
    }
    int residualSize() const override { return 1; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    int from_, to_, bias_keyframe_;
    double yaw_rad_, duration_s_, weight_;
};

}  // namespace rgbd_graphslam
