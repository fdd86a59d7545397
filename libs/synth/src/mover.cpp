#include "rgbd_graphslam/synth/mover.h"

namespace rgbd_graphslam::synth {

SE3 outOfSight() {
    return {Eigen::Matrix3d::Identity(), {0, 0, -1000}};
}

}  // namespace rgbd_graphslam::synth
