#include "rgbd_graphslam/dataset/registration_check.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace rgbd_graphslam {
namespace {

/** Edges are compared on images of this width: finer ones add time and noise. */
constexpr int reduced_width = 320;
constexpr double least_jump = 0.06;  // of the nearer depth
/** Depth often lacks beside a jump; over wider gaps (of 640 pixels) nothing is concluded. */
constexpr double longest_gap = 30.0 / 640;
constexpr std::size_t fewest_edges = 60, fewest_frames = 3;
constexpr double strongest_edge = 4;   // times the mean; beyond, an edge counts no more
constexpr double least_shift = 0.015;  // of the width
constexpr double halves_agree_px = 3;  // of the reduced image
constexpr int zero_px = 3;             // shifts so small count as none, of the reduced image
constexpr double least_gain = 0.3;     // standard deviations a frame

/** Strength of the colour edges of the reduced image, 1 on average. */
cv::Mat1f colorEdges(const cv::Mat& color, double scale) {
    cv::Mat grey, reduced;
    cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey, reduced, {}, scale, scale, cv::INTER_AREA);
    cv::Mat1f across, down, strength;
    cv::Sobel(reduced, across, CV_32F, 1, 0);
    cv::Sobel(reduced, down, CV_32F, 0, 1);
    cv::magnitude(across, down, strength);
    const double mean = std::max(1e-6, cv::mean(strength)[0]);
    return cv::min(strength, strongest_edge * mean) / mean;
}

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

/** The outlines of things in depth, every other row and column, in pixels of the reduced image. */
std::vector<cv::Point> depthEdges(const cv::Mat1w& depth, double scale) {
    const int gap = static_cast<int>(longest_gap * depth.cols);
    std::vector<cv::Point> edges;
    const auto add = [&](int u, int v) {
        edges.emplace_back(static_cast<int>(u * scale), static_cast<int>(v * scale));
    };
    for (int v = 0; v < depth.rows; v += 2) {
        findJumps(
            depth.cols, gap, [&](int u) { return depth(v, u); }, [&](int u) { add(u, v); });
    }
    for (int u = 0; u < depth.cols; u += 2) {
        findJumps(
            depth.rows, gap, [&](int v) { return depth(v, u); }, [&](int v) { add(u, v); });
    }
    return edges;
}

/** Mean strength of colour where depth has edges, these moved by up to `reach` pixels. */
cv::Mat1d agreement(const cv::Mat1f& strength, const std::vector<cv::Point>& edges, int reach) {
    cv::Mat1d result(2 * reach + 1, 2 * reach + 1, 0.0);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            double sum = 0;
            int count = 0;
            for (const auto& edge : edges) {
                const unsigned u = edge.x + x, v = edge.y + y;
                if (u >= unsigned(strength.cols) || v >= unsigned(strength.rows)) continue;
                sum += strength(static_cast<int>(v), static_cast<int>(u));
                ++count;
            }
            result(y + reach, x + reach) = sum / std::max(1, count);
        }
    }
    return result;
}

/** In standard deviations from the mean over all shifts, smoothed. */
cv::Mat1d standardised(const cv::Mat1d& values) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(values, mean, deviation);
    cv::Mat1d result = (values - mean[0]) / std::max(1e-9, deviation[0]);
    cv::GaussianBlur(result, result, {0, 0}, 1);
    return result;
}

cv::Point peakOf(const cv::Mat1d& values) {
    cv::Point peak;
    cv::minMaxLoc(values, nullptr, nullptr, nullptr, &peak);
    return peak;
}

}  // namespace

void RegistrationCheck::add(const cv::Mat& color, const cv::Mat& depth) {
    const double scale = std::min(1.0, static_cast<double>(reduced_width) / color.cols);
    const auto edges = depthEdges(depth, scale);
    if (edges.size() < fewest_edges) return;
    width_ = color.cols;
    agreement_[frames_++ % 2] += standardised(agreement(colorEdges(color, scale), edges, reach));
}

std::optional<Eigen::Vector2d> RegistrationCheck::misalignment() const {
    if (frames_ < fewest_frames) return std::nullopt;
    const cv::Mat1d all = agreement_[0] + agreement_[1];
    const cv::Point center(reach, reach), peak = peakOf(all);
    for (const auto& half : agreement_) {
        if (cv::norm(peakOf(half) - peak) > halves_agree_px) return std::nullopt;
    }
    double unmoved = 0;
    const cv::Rect near_zero(center - cv::Point(zero_px, zero_px),
                             cv::Size(2 * zero_px + 1, 2 * zero_px + 1));
    cv::minMaxLoc(all(near_zero), nullptr, &unmoved);
    const double pixels = width_ / static_cast<double>(std::min(width_, reduced_width));
    const Eigen::Vector2d off = pixels * Eigen::Vector2d(center.x - peak.x, center.y - peak.y);
    const bool clear = all(peak) - unmoved > least_gain * static_cast<double>(frames_);
    if (!clear || off.norm() < least_shift * width_) return std::nullopt;
    return off;
}

}  // namespace rgbd_graphslam
