#include "rgbd_graphslam/mapping/height_colors.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

std::array<Rgba, height_palette_size> makePalette() {
    constexpr double first = 22, last = 238;  // of OpenCV's 256 colors
    cv::Mat1b index(1, height_palette_size);
    for (int i = 0; i < height_palette_size; ++i)
        index(i) = cv::saturate_cast<uchar>(first + (last - first) * i / (height_palette_size - 1));
    cv::Mat3b bgr;
    cv::applyColorMap(index, bgr, cv::COLORMAP_TURBO);
    std::array<Rgba, height_palette_size> palette{};
    for (int i = 0; i < height_palette_size; ++i)
        palette[static_cast<std::size_t>(i)] = {bgr(i)[2], bgr(i)[1], bgr(i)[0], 255};
    return palette;
}

}  // namespace

const std::array<Rgba, height_palette_size>& heightPalette() {
    static const auto palette = makePalette();
    return palette;
}

Rgba heightColor(double share) {
    const double place = std::clamp(share, 0., 1.) * (height_palette_size - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min<std::size_t>(low + 1, height_palette_size - 1);
    const double between = place - static_cast<double>(low);
    Rgba color = heightPalette()[low];
    for (std::size_t c = 0; c < 3; ++c) {
        const double mixed = (1 - between) * color[c] + between * heightPalette()[high][c];
        color[c] = static_cast<std::uint8_t>(std::lround(mixed));
    }
    return color;
}

}  // namespace rgbd_graphslam
