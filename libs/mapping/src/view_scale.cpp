#include "rgbd_graphslam/mapping/view_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

constexpr double lines_a_side = 12, rounding = 1e-9;

struct Edge {
    Eigen::Vector3d start, direction;
    double from_m, to_m;  // along the direction
};

std::array<Edge, 2> facing(const FloorGrid& grid, const Eigen::Vector3d& eye) {
    const double x_middle = (grid.x_min_m + grid.x_max_m) / 2,
                 y_middle = (grid.y_min_m + grid.y_max_m) / 2;
    const double x = eye.x() < x_middle ? grid.x_min_m : grid.x_max_m;
    const double y = eye.y() < y_middle ? grid.y_min_m : grid.y_max_m;
    return {Edge{{0, y, 0}, Eigen::Vector3d::UnitX(), grid.x_min_m, grid.x_max_m},
            Edge{{x, 0, 0}, Eigen::Vector3d::UnitY(), grid.y_min_m, grid.y_max_m}};
}

/** All labels of a floor have one unit. */
std::string distanceText(double m, const FloorGrid& grid) {
    const double longest_m = std::max(grid.x_max_m - grid.x_min_m, grid.y_max_m - grid.y_min_m);
    if (longest_m < 1) return formatted("%g cm", std::round(1e4 * m) / 100);
    return formatted("%g m", std::round(1e3 * m) / 1e3 + 0.);
}

/** Places along an edge that are in the picture. */
std::vector<SceneLabel> candidates(const FloorGrid& grid, const Edge& edge, double step_m,
                                   const OrbitCamera& camera, const Eigen::Vector2i& size_px) {
    std::vector<SceneLabel> labels;
    const double first = std::ceil(edge.from_m / step_m - rounding);
    for (double i = first; i * step_m <= edge.to_m + rounding; ++i) {
        const Eigen::Vector3d p = edge.start + i * step_m * edge.direction;
        const Eigen::Vector3d uvz = camera.project(p, size_px);
        const bool is_in = uvz.z() > 0 && uvz.x() >= 0 && uvz.y() >= 0 && uvz.x() < size_px.x() &&
                           uvz.y() < size_px.y();
        if (is_in) labels.push_back({uvz.head<2>(), distanceText(i * step_m, grid)});
    }
    return labels;
}

double smallestGap(const std::vector<SceneLabel>& labels) {
    double gap = 1e9;
    for (std::size_t i = 1; i < labels.size(); ++i)
        gap = std::min(gap, (labels[i].pixel - labels[i - 1].pixel).norm());
    return gap;
}

}  // namespace

double roundLength(double most_m) {
    const double power = std::pow(10, std::floor(std::log10(most_m) + rounding));
    const double digit = most_m / power + rounding;
    return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

std::string lengthText(double length_m) {
    const double size = std::abs(length_m);
    if (size < 1e-6) return "0 m";
    if (size < 0.995) return formatted("%g cm", std::round(1e4 * length_m) / 100);
    if (size < 999.5) return formatted("%g m", std::round(1e3 * length_m) / 1e3);
    return formatted("%g km", std::round(length_m) / 1e3);
}

ScaleBar scaleBar(double m_per_px, double most_px) {
    const double length_m = roundLength(m_per_px * most_px);
    return {length_m, length_m / m_per_px};
}

FloorGrid floorGrid(const Eigen::AlignedBox3d& box) {
    FloorGrid grid;
    if (box.isEmpty()) return grid;
    const double longer = std::max({box.sizes().x(), box.sizes().y(), 0.1});
    const double finer = roundLength(longer / lines_a_side);
    const double mantissa = finer / std::pow(10, std::floor(std::log10(finer) + rounding));
    const bool is_round = finer >= longer / lines_a_side - rounding;
    grid.step_m = is_round ? finer : finer * (std::abs(mantissa - 2) < 0.1 ? 2.5 : 2);
    const auto down = [&](double m) { return grid.step_m * std::floor(m / grid.step_m); };
    const auto up = [&](double m) { return grid.step_m * std::ceil(m / grid.step_m); };
    grid.x_min_m = down(box.min().x());
    grid.x_max_m = up(box.max().x());
    grid.y_min_m = down(box.min().y());
    grid.y_max_m = up(box.max().y());
    return grid;
}

std::vector<SceneLabel> floorLabels(const FloorGrid& grid, const OrbitCamera& camera,
                                    const Eigen::Vector2i& size_px, double least_px) {
    std::vector<SceneLabel> labels;
    for (const Edge& edge : facing(grid, camera.eye())) {
        std::vector<SceneLabel> some;
        for (const double multiple : {1, 2, 5, 10, 20, 50}) {
            some = candidates(grid, edge, multiple * grid.step_m, camera, size_px);
            if (smallestGap(some) >= least_px) break;
        }
        if (smallestGap(some) < least_px) some.resize(1);
        for (const SceneLabel& label : some) {
            const bool is_free =
                std::all_of(labels.begin(), labels.end(), [&](const SceneLabel& other) {
                    return (other.pixel - label.pixel).norm() >= least_px;
                });
            if (is_free) labels.push_back(label);
        }
    }
    return labels;
}

}  // namespace rgbd_graphslam
