#include "rgbd_graphslam/geometry/surface_sampling.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <tuple>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using Take = std::function<void(const Eigen::Vector3d&, double)>;
using Triangle = std::array<Eigen::Vector3d, 3>;

std::vector<Triangle> trianglesOf(const PlyModel& surface) {
    std::vector<Triangle> triangles;
    triangles.reserve(surface.triangles.size());
    for (const auto& corners : surface.triangles) {
        Triangle triangle;
        for (int k = 0; k < 3; ++k) triangle[k] = surface.vertices[corners[k]].cast<double>();
        triangles.push_back(triangle);
    }
    return triangles;
}

/** A surface in millimeters would take days. */
void checkArea(const std::vector<Triangle>& triangles, double spacing_m) {
    constexpr double most_samples = 1e9;
    double area = 0;
    for (const auto& [a, b, c] : triangles) area += (b - a).cross(c - a).norm() / 2;
    if (!(area / spacing_m / spacing_m < most_samples)) {
        throw Error("the surface measures " + std::to_string(area) + " square meters",
                    "give one in meters");
    }
}

/** The corners in the same sense, the longest side between the first two. */
Triangle longestSideFirst(Triangle triangle) {
    auto& [a, b, c] = triangle;
    for (int turn = 0; turn < 2; ++turn) {
        if ((c - b).norm() > (b - a).norm() || (a - c).norm() > (b - a).norm()) {
            std::tie(a, b, c) = std::make_tuple(b, c, a);
        }
    }
    return triangle;
}

/** Samples in rows along the longest side, at most `spacing_m` apart; each stands for its part of
 *  the area, so that thin triangles weigh and cost no more than they should. */
void sampleTriangle(const Triangle& triangle, double spacing_m, const Take& take) {
    const auto [a, b, c] = longestSideFirst(triangle);
    const double side_m = (b - a).norm(), area = (b - a).cross(c - a).norm() / 2;
    if (area <= 0) return;
    const int rows = static_cast<int>(std::ceil(2 * area / side_m / spacing_m));
    for (int row = 0; row < rows; ++row) {
        const double bottom = 1.0 * row / rows, top = (row + 1.0) / rows;
        const double up = (bottom + top) / 2;
        const double row_area = area * ((1 - bottom) * (1 - bottom) - (1 - top) * (1 - top));
        const int count = static_cast<int>(std::ceil(side_m * (1 - up) / spacing_m));
        const Eigen::Vector3d start = a + up * (c - a), along = (1 - up) * (b - a);
        for (int k = 0; k < count; ++k) take(start + (k + 0.5) / count * along, row_area / count);
    }
}

}  // namespace

void forEachSurfaceSample(const PlyModel& surface, double spacing_m, const Take& take) {
    if (surface.triangles.empty()) {
        for (const auto& vertex : surface.vertices) take(vertex.cast<double>(), 1);
        return;
    }
    const auto triangles = trianglesOf(surface);
    checkArea(triangles, spacing_m);
    for (const auto& triangle : triangles) sampleTriangle(triangle, spacing_m, take);
}

}  // namespace rgbd_graphslam
