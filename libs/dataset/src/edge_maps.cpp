#include "edge_maps.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr double least_jump = 0.06;  // of the nearer depth
/** Depth often lacks beside a jump; over wider gaps (of 640 pixels) nothing is concluded. */
constexpr double longest_gap = 30.0 / 640;
constexpr double strongest_edge = 4;  // times the mean; beyond, an edge counts no more
/** What an edge is compared with, of the width. */
constexpr double surroundings = 1.0 / 8;

/** Calls take(i) at the nearer side of each jump along a line. \param at depth at i, 0 = none */
template <class At, class Take>
void findJumps(int length, int gap, At at, Take take) {
    int last = -1;
    for (int i = 0; i < length; ++i) {
        const int depth = at(i);
        if (depth == 0) continue;
        if (last >= 0 && i - last <= gap) {
            const int before = at(last);
            if (std::abs(depth - before) > least_jump * std::min(depth, before)) {
                take(depth < before ? i : last);
            }
        }
        last = i;
    }
}

}  // namespace

cv::Mat1f edgeContrast(const cv::Mat& color, int width) {
    const double scale = std::min(1.0, static_cast<double>(width) / color.cols);
    cv::Mat reduced, gray;
    cv::resize(color, reduced, {}, scale, scale, cv::INTER_AREA);
    cv::cvtColor(reduced, gray, cv::COLOR_BGR2GRAY);
    cv::Mat1f across, down, strength, around;
    cv::Sobel(gray, across, CV_32F, 1, 0);
    cv::Sobel(gray, down, CV_32F, 0, 1);
    cv::magnitude(across, down, strength);
    strength = cv::min(strength, strongest_edge * cv::mean(strength)[0]);
    cv::GaussianBlur(strength, strength, {3, 3}, 0);
    const int side = 2 * static_cast<int>(surroundings * strength.cols / 2) + 1;
    cv::boxFilter(strength, around, -1, {side, side});
    strength -= around;
    cv::Scalar mean, deviation;
    cv::meanStdDev(strength, mean, deviation);
    return (strength - mean[0]) / std::max(1e-6, deviation[0]);
}

std::vector<Eigen::Vector2f> depthOutlines(const cv::Mat& image, std::size_t most) {
    const cv::Mat1w depth = image;
    const int gap = std::max(1, static_cast<int>(longest_gap * depth.cols));
    std::vector<Eigen::Vector2f> all;
    for (int v = 0; v < depth.rows; v += 2) {
        findJumps(
            depth.cols, gap, [&](int u) { return depth(v, u); },
            [&](int u) { all.emplace_back(u, v); });
    }
    for (int u = 0; u < depth.cols; u += 2) {
        findJumps(
            depth.rows, gap, [&](int v) { return depth(v, u); },
            [&](int v) { all.emplace_back(u, v); });
    }
    if (all.size() <= most) return all;
    std::vector<Eigen::Vector2f> chosen;
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(all[i * all.size() / most]);
    return chosen;
}

cv::Mat1d agreementAt(const cv::Mat1f& contrast, const std::vector<Eigen::Vector2f>& outlines,
                      int width, const Placement& placement, int reach) {
    constexpr double fewest_inside = 0.2;  // as many count at least, lest a handful decide
    cv::Mat1f framed;
    cv::copyMakeBorder(contrast, framed, reach, reach, reach, reach, cv::BORDER_CONSTANT, 0);
    const double reduction = static_cast<double>(contrast.cols) / width;
    const cv::Point2d center(0.5 * contrast.cols, 0.5 * contrast.rows);
    std::vector<std::ptrdiff_t> places;
    for (const auto& outline : outlines) {
        const cv::Point2d reduced(outline.x() * reduction, outline.y() * reduction);
        const cv::Point2d at = placement.scale * (reduced - center) + center + placement.shift;
        const int u = static_cast<int>(std::lround(at.x)), v = static_cast<int>(std::lround(at.y));
        if (u < 0 || v < 0 || u >= contrast.cols || v >= contrast.rows) continue;
        places.push_back(std::ptrdiff_t{v + reach} * framed.cols + u + reach);
    }
    const double count = std::max(static_cast<double>(places.size()),
                                  fewest_inside * static_cast<double>(outlines.size()));
    cv::Mat1d result(2 * reach + 1, 2 * reach + 1, 0.0);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const float* moved = framed.ptr<float>() + std::ptrdiff_t{y} * framed.cols + x;
            float sum = 0;
            for (const std::ptrdiff_t place : places) sum += moved[place];
            result(y + reach, x + reach) = sum / std::sqrt(std::max(1.0, count));
        }
    }
    return result;
}

}  // namespace rgbd_graphslam
