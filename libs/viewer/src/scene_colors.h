/** Colors of the marks in the image of a running SLAM. */
#pragma once
#include "rgbd_graphslam/mapping/scene_colors.h"

namespace rgbd_graphslam {

inline constexpr Rgba tracked_color = {60, 220, 90, 255}, new_color = {70, 150, 255, 255},
                      lost_color = {255, 60, 60, 255};

}  // namespace rgbd_graphslam
