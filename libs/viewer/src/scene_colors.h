/** Colours of what is drawn, and of their names in the panels. */
#pragma once
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

inline constexpr Rgba floor_color = {198, 204, 213, 255}, trajectory_color = {235, 95, 0, 255},
                      truth_color = {20, 140, 60, 255}, error_color = {190, 60, 190, 255},
                      keyframe_color = {30, 90, 200, 255},
                      covisibility_color = {120, 170, 120, 255}, loop_color = {215, 25, 60, 255},
                      before_color = {130, 130, 140, 255}, now_color = {235, 95, 0, 255},
                      selection_color = {255, 190, 0, 255}, measure_color = {200, 0, 200, 255};

inline constexpr Rgba tracked_color = {60, 220, 90, 255}, new_color = {70, 150, 255, 255},
                      lost_color = {255, 60, 60, 255};

}  // namespace rgbd_graphslam
