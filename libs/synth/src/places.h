/** The places that scenarios play in. */
#pragma once
#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** An office of 6.4 x 5.2 m with four workplaces around an open middle; origin in a corner. */
Scene officeRoom(std::uint64_t seed);

}  // namespace rgbd_graphslam::synth
