#include "rgbd_graphslam/export/atlas_packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** \return nothing when a picture of that width gets higher than that */
std::optional<AtlasLayout> packed(const std::vector<cv::Size>& sizes,
                                  const std::vector<std::size_t>& order, double scale, int width_px,
                                  int most_px) {
    AtlasLayout layout;
    layout.scale = scale;
    layout.corners.resize(sizes.size());
    cv::Point next(0, 0);
    int row_height = 0;
    for (const std::size_t i : order) {
        const cv::Size size = scaled(sizes[i], scale);
        if (size.width > width_px) return std::nullopt;
        if (next.x + size.width > width_px) {
            next = {0, next.y + row_height};
            row_height = 0;
        }
        if (next.y + size.height > most_px) return std::nullopt;
        row_height = std::max(row_height, size.height);
        layout.corners[i] = next;
        next.x += size.width;
    }
    layout.size = {width_px, std::max(1, next.y + row_height)};
    return layout;
}

}  // namespace

cv::Size scaled(const cv::Size& size, double scale) {
    const auto length = [&](int pixels) {
        return std::max(1, static_cast<int>(std::ceil(scale * pixels)));
    };
    return {length(size.width), length(size.height)};
}

AtlasLayout packAtlas(const std::vector<cv::Size>& sizes, int most_px) {
    constexpr int smallest_px = 256;
    constexpr double shrink = 0.9, smallest_scale = 0.01;
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sizes[a].height > sizes[b].height;
    });
    for (int width_px = std::min(smallest_px, most_px); width_px < most_px; width_px *= 2) {
        if (auto layout = packed(sizes, order, 1, width_px, width_px)) return *layout;
    }
    for (double scale = 1; scale > smallest_scale; scale *= shrink) {
        if (auto layout = packed(sizes, order, scale, most_px, most_px)) return *layout;
    }
    throw Error("the texture does not fit into " + std::to_string(most_px) + " x " +
                    std::to_string(most_px) + " pixels",
                "give a larger --texture-size, or a coarser mesh: rgbd-map OUT --mesh 0.04");
}

}  // namespace rgbd_graphslam
