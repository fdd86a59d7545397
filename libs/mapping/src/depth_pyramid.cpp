#include "rgbd_graphslam/mapping/depth_pyramid.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

const cv::Vec2f nothing(std::numeric_limits<float>::infinity(), 0.f);

cv::Vec2f merged(const cv::Vec2f& a, const cv::Vec2f& b) {
    return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

cv::Mat2f baseLevel(const cv::Mat1f& depth) {
    cv::Mat2f level(depth.size());
    for (int v = 0; v < depth.rows; ++v) {
        const float* z = depth[v];
        cv::Vec2f* out = level[v];
        for (int u = 0; u < depth.cols; ++u) out[u] = z[u] > 0 ? cv::Vec2f(z[u], z[u]) : nothing;
    }
    return level;
}

cv::Mat2f halved(const cv::Mat2f& fine) {
    cv::Mat2f level((fine.rows + 1) / 2, (fine.cols + 1) / 2);
    for (int v = 0; v < level.rows; ++v) {
        const cv::Vec2f* upper = fine[2 * v];
        const cv::Vec2f* lower = fine[std::min(2 * v + 1, fine.rows - 1)];
        for (int u = 0; u < level.cols; ++u) {
            const int left = 2 * u, right = std::min(2 * u + 1, fine.cols - 1);
            level(v, u) =
                merged(merged(upper[left], upper[right]), merged(lower[left], lower[right]));
        }
    }
    return level;
}

}  // namespace

DepthPyramid::DepthPyramid(const cv::Mat1f& depth) {
    levels_.push_back(baseLevel(depth));
    while (levels_.back().rows > 1 || levels_.back().cols > 1)
        levels_.push_back(halved(levels_.back()));
    const cv::Mat valid = (depth > 0) / 255;
    cv::integral(valid, count_, CV_32S);
}

DepthPyramid::Side DepthPyramid::sideOf(const PixelRect& rect, float near_m, float far_m) const {
    constexpr int tiles_across = 4;  // wide enough to fit the rectangle well, few enough to be fast
    std::size_t level = 0;
    const int extent = std::max(rect.u1 - rect.u0, rect.v1 - rect.v0);
    while (extent >> level >= tiles_across) ++level;
    // What larger tiles tell for certain, smaller ones would not tell otherwise.
    const std::size_t coarse = std::min(level + 2, levels_.size() - 1);
    const Side side = sideAt(coarse, rect, near_m, far_m);
    return side == Side::Across ? sideAt(level, rect, near_m, far_m) : side;
}

DepthPyramid::Side DepthPyramid::sideAt(std::size_t level, const PixelRect& rect, float near_m,
                                        float far_m) const {
    const cv::Mat2f& tiles = levels_[level];
    bool some_behind = false, some_before = false;
    for (int v = rect.v0 >> level; v <= rect.v1 >> level; ++v) {
        const cv::Vec2f* row = tiles[v];
        for (int u = rect.u0 >> level; u <= rect.u1 >> level; ++u) {
            some_before |= row[u][0] <= far_m;
            some_behind |= row[u][1] > near_m;
        }
        if (some_before && some_behind) return Side::Across;
    }
    return some_behind ? Side::Clear : Side::Hidden;
}

int DepthPyramid::readings(const PixelRect& rect) const {
    const int *upper = count_[rect.v0], *lower = count_[rect.v1 + 1];
    return lower[rect.u1 + 1] - lower[rect.u0] - upper[rect.u1 + 1] + upper[rect.u0];
}

float DepthPyramid::farthest() const {
    return levels_.back()(0, 0)[1];
}

}  // namespace rgbd_graphslam
