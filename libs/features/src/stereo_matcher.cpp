#include "rgbd_graphslam/features/stereo_matcher.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "vector_clones.h"

namespace rgbd_graphslam {
namespace {

/** Window of the search: columns from -8 to 7, which is one vector, rows from -5 to 5. */
constexpr int columns = 16, half_columns = columns / 2, half_rows = 5;
/** Horizontal gradients (sum over three rows) are cut off here. */
constexpr int edge_cap = 63;
/** A second best disparity must be worse by this factor. */
constexpr double uniqueness = 1.15;
/** Window of the refinement. */
constexpr int radius = 5, side = 2 * radius + 1;
constexpr int iterations = 10;
constexpr float converged_px = 0.005f, farthest_refined_px = 1.5f;
constexpr float smallest_disparity_px = 0.5f;
/** Gray levels: noise of images, and differences of a wrong match. */
constexpr float gray_noise = 3, worst_residual = 20;
constexpr float largest_sigma_px = 0.4f;
/** Standard deviation of the slope of disparities: of a floor half a baseline below. */
constexpr float slope_sigma = 0.5f;

std::uint8_t cappedEdge(int gradient) {
    return static_cast<std::uint8_t>(std::clamp(gradient / 2, -edge_cap, edge_cap) + edge_cap);
}

/** Sobel's horizontal gradient in 8 bits: unlike gray values it is the same in a darker image. */
cv::Mat edgesOf(const cv::Mat& image) {
    cv::Mat edges(image.size(), CV_8UC1, cv::Scalar(edge_cap));
    for (int y = 1; y + 1 < image.rows; ++y) {
        const std::uint8_t* rows[] = {image.ptr<std::uint8_t>(y - 1), image.ptr<std::uint8_t>(y),
                                      image.ptr<std::uint8_t>(y + 1)};
        auto* out = edges.ptr<std::uint8_t>(y);
        for (int x = 1; x + 1 < image.cols; ++x) {
            out[x] =
                cappedEdge(rows[0][x + 1] - rows[0][x - 1] + 2 * (rows[1][x + 1] - rows[1][x - 1]) +
                           rows[2][x + 1] - rows[2][x - 1]);
        }
    }
    return edges;
}

/** Sum of absolute differences of two windows. \param a, b their top left pixels */
inline int difference(const std::uint8_t* a, std::size_t step_a, const std::uint8_t* b,
                      std::size_t step_b) {
    int sum = 0;
    for (int y = 0; y <= 2 * half_rows; ++y, a += step_a, b += step_b) {
        for (int x = 0; x < columns; ++x) sum += std::abs(a[x] - b[x]);
    }
    return sum;
}

/** \param costs of `count` windows, each `direction` pixels from the one before */
RGBD_VECTOR_CLONES
void compareAll(const std::uint8_t* window, std::size_t step_a, const std::uint8_t* first,
                std::size_t step_b, int direction, int count, int* costs) {
    for (int i = 0; i < count; ++i) {
        costs[i] = difference(window, step_a, first + i * direction, step_b);
    }
}

const std::uint8_t* corner(const cv::Mat& image, int x, int y) {
    return image.ptr<std::uint8_t>(y - half_rows) + x - half_columns;
}

float bilinear(const cv::Mat& image, float u, float v) {
    const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
    const float a = u - static_cast<float>(x), b = v - static_cast<float>(y);
    const auto *top = image.ptr<std::uint8_t>(y) + x, *bottom = image.ptr<std::uint8_t>(y + 1) + x;
    return (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * bottom[0] + a * bottom[1]);
}

/** Gray values of a window around a point. */
using Window = std::array<float, side * side>;

/** What one pixel more of disparity, of its slopes and of brightness do to the right window. */
struct Template {
    Window gray;
    std::array<Eigen::Vector4f, side * side> gradient;
    Eigen::Matrix4f inverse_normal;
    float information = 0;  // on the disparity

    Template(const cv::Mat& image, float u, float v);
};

Template::Template(const cv::Mat& image, float u, float v) {
    Eigen::Matrix4f normal = Eigen::Matrix4f::Zero();
    for (int j = -radius, i = 0; j <= radius; ++j) {
        for (int k = -radius; k <= radius; ++k, ++i) {
            const float x = u + static_cast<float>(k), y = v + static_cast<float>(j);
            gray[i] = bilinear(image, x, y);
            const float g = 0.5f * (bilinear(image, x + 1, y) - bilinear(image, x - 1, y));
            gradient[i] = {g, g * static_cast<float>(k), g * static_cast<float>(j), 1};
            normal += gradient[i] * gradient[i].transpose();
        }
    }
    const float slope_information = gray_noise * gray_noise / (slope_sigma * slope_sigma);
    normal(1, 1) += slope_information;
    normal(2, 2) += slope_information;
    normal(0, 0) += 1e-3f;
    inverse_normal = normal.inverse();
    information = 1 / inverse_normal(0, 0);
}

/** Disparity at the middle of the window, its slopes along columns and rows, and how much brighter
 *  the right image is. */
using Warp = Eigen::Vector4f;

/** \return whether all of the window is in the image */
bool sample(const cv::Mat& image, float u, float v, const Warp& warp, Window& window) {
    for (int j = -radius, i = 0; j <= radius; ++j) {
        for (int k = -radius; k <= radius; ++k, ++i) {
            const auto column = static_cast<float>(k), row = static_cast<float>(j);
            const float x = u + column - (warp[0] + warp[1] * column + warp[2] * row);
            if (!(x >= 0 && x < static_cast<float>(image.cols - 1))) return false;
            window[i] = bilinear(image, x, v + row);
        }
    }
    return true;
}

/** One step of Gauss and Newton. \param residual root mean square, gray levels */
Warp step(const Template& reference, const Window& window, const Warp& warp, float& residual) {
    Eigen::Vector4f b = Eigen::Vector4f::Zero();
    float squares = 0;
    for (int i = 0; i < side * side; ++i) {
        const float e = window[i] - reference.gray[i] - warp[3];
        squares += e * e;
        b += e * reference.gradient[i];
    }
    residual = std::sqrt(squares / (side * side));
    return reference.inverse_normal * b;
}

}  // namespace

StereoMatcher::StereoMatcher(const cv::Mat& left, const cv::Mat& right, int largest_disparity)
    : left_(left),
      right_(right),
      left_edges_(edgesOf(left)),
      right_edges_(edgesOf(right)),
      largest_disparity_(largest_disparity) {}

std::optional<float> StereoMatcher::disparityAt(float u, float v) const {
    const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
    constexpr int border = half_columns + 1;
    if (x < border || y < border || x >= left_.cols - border || y >= left_.rows - border) {
        return std::nullopt;
    }
    const auto whole = searchRow(x, y);
    if (!whole) return std::nullopt;
    return refine(u, v, static_cast<float>(*whole));
}

/** The way there and the way back. */
std::optional<int> StereoMatcher::searchRow(int x, int y) const {
    int second = 0;
    const int disparity = bestRight(x, y, second);
    if (disparity < 0) return std::nullopt;
    const int back = bestLeft(x - disparity, y);
    if (std::abs(back - disparity) > 1) return std::nullopt;
    return disparity;
}

/** \param second cost of the best disparity that is not beside the best
 *  \return -1 where none stands out */
int StereoMatcher::bestRight(int x, int y, int& second) const {
    static thread_local std::vector<int> costs;
    const int count = std::min(largest_disparity_, x - half_columns) + 1;
    costs.resize(count);
    compareAll(corner(left_edges_, x, y), left_edges_.step, corner(right_edges_, x, y),
               right_edges_.step, -1, count, costs.data());
    const int best = static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    second = INT_MAX;
    for (int d = 0; d < count; ++d) {
        if (std::abs(d - best) > 1) second = std::min(second, costs[d]);
    }
    return second > uniqueness * costs[best] ? best : -1;
}

int StereoMatcher::bestLeft(int x_right, int y) const {
    static thread_local std::vector<int> costs;
    const int count =
        std::min(largest_disparity_, left_edges_.cols - half_columns - x_right - 1) + 1;
    costs.resize(count);
    compareAll(corner(right_edges_, x_right, y), right_edges_.step, corner(left_edges_, x_right, y),
               left_edges_.step, 1, count, costs.data());
    return static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

std::optional<float> StereoMatcher::refine(float u, float v, float disparity) const {
    const Template reference(left_, u, v);
    const float sigma_px = gray_noise / std::sqrt(reference.information);
    if (!(sigma_px <= largest_sigma_px)) return std::nullopt;
    Warp warp(disparity, 0, 0, 0);
    Window window;
    float residual = 0;
    for (int i = 0; i < iterations; ++i) {
        if (!sample(right_, u, v, warp, window)) return std::nullopt;
        const Warp change = step(reference, window, warp, residual);
        warp += change;
        if (!(std::abs(warp[0] - disparity) <= farthest_refined_px)) return std::nullopt;
        if (std::abs(change[0]) < converged_px) break;
    }
    if (residual > worst_residual || warp[0] < smallest_disparity_px) return std::nullopt;
    return warp[0];
}

}  // namespace rgbd_graphslam
