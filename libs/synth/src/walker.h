/** People who walk about. */
#pragma once
#include <functional>
#include <vector>

#include "rgbd_graphslam/synth/motion.h"

namespace rgbd_graphslam::synth {

/** Walks round a closed way for ever, swinging arms and legs. */
class Walker {
  public:
    Walker(const std::vector<Eigen::Vector3d>& way, double speed);
    SE3 trunk(double t) const;
    /** \param side -1 right, 1 left */
    SE3 leg(double t, int side) const;
    SE3 arm(double t, int side) const;

  private:
    SE3 joint(double t, const Eigen::Vector3d& at, double swing_rad) const;
    Spline way_;
    double steps_hz_;
};

/** Appends the poses of trunk, two legs and two arms, as addPerson adds the figures. */
void addWalker(const Walker& walker, std::vector<std::function<SE3(double)>>& poses);

}  // namespace rgbd_graphslam::synth
