#include "rgbd_graphslam/evaluation/map_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "point_tree.h"
#include "rgbd_graphslam/core/error.h"
#include "triangle_tree.h"

namespace rgbd_graphslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void check(const PlyModel& map, const MapAccuracyOptions& options) {
    if (map.vertices.empty()) throw Error("the map holds no points", "give another");
    if (!(options.completeness_distance_m > 0) || !(options.sample_spacing_m > 0)) {
        throw Error("the distances of a map's evaluation must be positive", "give metres");
    }
}

Points alignedPoints(const PlyModel& model, const Similarity& alignment) {
    Points points;
    points.reserve(model.vertices.size());
    for (const auto& vertex : model.vertices) {
        points.push_back(alignment * Eigen::Vector3d(vertex.cast<double>()));
    }
    return points;
}

template <class Tree>
std::vector<double> distancesTo(const Tree& tree, const Points& points) {
    std::vector<double> distances_m;
    distances_m.reserve(points.size());
    for (const auto& p : points) distances_m.push_back(tree.distanceTo(p));
    return distances_m;
}

std::vector<double> distancesToSurface(const Points& points, const PlyModel& surface) {
    if (!surface.triangles.empty()) return distancesTo(TriangleTree(surface), points);
    const Points samples = alignedPoints(surface, {});
    return distancesTo(PointTree(samples), points);
}

/** Adds up how much of a surface is near the map. */
class Coverage {
  public:
    Coverage(const Points& map, double distance_m) : tree_(map), distance_m_(distance_m) {}

    void sample(const Eigen::Vector3d& p, double area) {
        ++samples_;
        total_ += area;
        if (tree_.distanceTo(p) <= distance_m_) covered_ += area;
    }

    /** Samples in rows along the longest side, at most `spacing_m` apart; each stands for its part
     *  of the area, so that thin triangles weigh and cost no more than they should. */
    void sampleTriangle(Eigen::Vector3d a, Eigen::Vector3d b, Eigen::Vector3d c, double spacing_m) {
        for (int turn = 0; turn < 2; ++turn) {
            if ((c - b).norm() > (b - a).norm() || (a - c).norm() > (b - a).norm()) {
                std::tie(a, b, c) = std::make_tuple(b, c, a);
            }
        }
        const double side_m = (b - a).norm(), area = (b - a).cross(c - a).norm() / 2;
        if (area <= 0) return;
        const int rows = static_cast<int>(std::ceil(2 * area / side_m / spacing_m));
        for (int row = 0; row < rows; ++row) {
            const double bottom = 1.0 * row / rows, top = (row + 1.0) / rows;
            const double up = (bottom + top) / 2;
            const double row_area = area * ((1 - bottom) * (1 - bottom) - (1 - top) * (1 - top));
            const int count = static_cast<int>(std::ceil(side_m * (1 - up) / spacing_m));
            const Eigen::Vector3d start = a + up * (c - a), along = (1 - up) * (b - a);
            for (int k = 0; k < count; ++k) {
                sample(start + (k + 0.5) / count * along, row_area / count);
            }
        }
    }

    double share() const { return total_ > 0 ? covered_ / total_ : 0; }
    std::size_t samples() const { return samples_; }

  private:
    PointTree tree_;
    double distance_m_;
    double covered_ = 0, total_ = 0;
    std::size_t samples_ = 0;
};

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

/** A surface in millimetres would take days. */
void checkArea(const std::vector<Triangle>& triangles, double spacing_m) {
    constexpr double most_samples = 1e9;
    double area = 0;
    for (const auto& [a, b, c] : triangles) area += (b - a).cross(c - a).norm() / 2;
    if (!(area / spacing_m / spacing_m < most_samples)) {
        throw Error("the surface measures " + std::to_string(area) + " square metres",
                    "give one in metres");
    }
}

void sampleSurface(const PlyModel& surface, double spacing_m, Coverage& coverage) {
    if (surface.triangles.empty()) {
        for (const auto& vertex : surface.vertices) coverage.sample(vertex.cast<double>(), 1);
        return;
    }
    const auto triangles = trianglesOf(surface);
    checkArea(triangles, spacing_m);
    for (const auto& [a, b, c] : triangles) coverage.sampleTriangle(a, b, c, spacing_m);
}

}  // namespace

MapAccuracy evaluateMap(const PlyModel& map, const PlyModel& surface,
                        const MapAccuracyOptions& options) {
    check(map, options);
    const Points points = alignedPoints(map, options.alignment);
    const auto distances_m = distancesToSurface(points, surface);
    MapAccuracy accuracy;
    accuracy.distance_m = statisticsOf(distances_m);
    accuracy.distance_95_m = percentileOf(distances_m, 0.95);
    Coverage coverage(points, options.completeness_distance_m);
    sampleSurface(surface, options.sample_spacing_m, coverage);
    accuracy.completeness = coverage.share();
    accuracy.surface_samples = coverage.samples();
    return accuracy;
}

}  // namespace rgbd_graphslam
