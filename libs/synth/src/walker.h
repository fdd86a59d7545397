/** People who walk about. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/synth/motion.h"
#include "rgbd_graphslam/synth/mover.h"

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

/** Appends trunk, two legs and two arms, in the order in which Furnisher::person() adds them.
 *  \param start_s how long the walk has lasted at time 0 */
void addWalker(const Walker& walker, const std::string& name, std::vector<Mover>& movers,
               double start_s = 0);

}  // namespace rgbd_graphslam::synth
