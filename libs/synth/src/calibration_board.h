/** A scenario to calibrate with. */
#pragma once
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

/** A chessboard of 10 x 7 squares of 60 mm, before which a camera is moved about. */
Scenario board();

}  // namespace rgbd_graphslam::synth
