#include "rgbd_graphslam/evaluation/map_accuracy.h"

#include <algorithm>
#include <cmath>

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

    /** Samples at the centres of n^2 congruent parts, whose edges are at most `spacing_m` long. */
    void sampleTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c, double spacing_m) {
        const double longest_m = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const int n = std::max(1, static_cast<int>(std::ceil(longest_m / spacing_m)));
        const double area = (b - a).cross(c - a).norm() / 2 / n / n;
        const Eigen::Vector3d u = (b - a) / n, v = (c - a) / n;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                sample(a + (i + 1 / 3.0) * u + (j + 1 / 3.0) * v, area);
                if (i + j + 1 < n) sample(a + (i + 2 / 3.0) * u + (j + 2 / 3.0) * v, area);
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

void sampleSurface(const PlyModel& surface, double spacing_m, Coverage& coverage) {
    if (surface.triangles.empty()) {
        for (const auto& vertex : surface.vertices) coverage.sample(vertex.cast<double>(), 1);
        return;
    }
    for (const auto& [a, b, c] : surface.triangles) {
        coverage.sampleTriangle(surface.vertices[a].cast<double>(),
                                surface.vertices[b].cast<double>(),
                                surface.vertices[c].cast<double>(), spacing_m);
    }
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
