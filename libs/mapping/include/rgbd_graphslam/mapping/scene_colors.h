/** Colors of what is drawn in pictures of a map, the same in all of them. */
#pragma once
#include <array>
#include <cstdint>

namespace rgbd_graphslam {

using Rgba = std::array<std::uint8_t, 4>;

/** Slate: white walls and dark furniture both stand out against it. */
inline constexpr Rgba background_color = {50, 58, 69, 255}, floor_color = {82, 92, 106, 255},
                      label_color = {190, 198, 208, 255};

inline constexpr Rgba trajectory_color = {255, 150, 40, 255}, truth_color = {90, 220, 120, 255},
                      error_color = {235, 120, 235, 255}, keyframe_color = {95, 165, 255, 255},
                      covisibility_color = {120, 170, 120, 255}, loop_color = {255, 70, 95, 255},
                      before_color = {165, 170, 182, 255}, now_color = {255, 150, 40, 255},
                      selection_color = {255, 215, 60, 255}, measure_color = {255, 90, 255, 255};

}  // namespace rgbd_graphslam
