/** Colors that stand for heights. */
#pragma once
#include <array>

#include "rgbd_graphslam/mapping/scene_colors.h"

namespace rgbd_graphslam {

/** Turbo (Mikhailov, "Turbo, an improved rainbow colormap for visualization", 2019) without its
 *  darkest ends, which would not stand out against the background: equal steps of height look
 *  about equally far apart, and no hue appears twice. From low to high, to be interpolated
 *  linearly. */
inline constexpr int height_palette_size = 32;
const std::array<Rgba, height_palette_size>& heightPalette();

/** \param share of the range, from its low end; clamped to [0, 1] */
Rgba heightColor(double share);

}  // namespace rgbd_graphslam
