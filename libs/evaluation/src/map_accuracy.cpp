#include "rgbd_graphslam/evaluation/map_accuracy.h"

#include "point_tree.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/surface_sampling.h"
#include "triangle_tree.h"

namespace rgbd_graphslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void check(const PlyModel& map, const MapAccuracyOptions& options) {
    if (map.vertices.empty()) throw Error("the map holds no points", "give another");
    if (!(options.completeness_distance_m > 0) || !(options.sample_spacing_m > 0) ||
        !(options.beyond_m > 0)) {
        throw Error("the distances of a map's evaluation must be positive", "give meters");
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

/** Share of the points that are farther than allowed, and `counts` says count. */
template <class Counts>
double shareBeyond(const Points& points, const std::vector<double>& distances_m, double beyond_m,
                   Counts counts) {
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (distances_m[i] > beyond_m && counts(points[i])) ++beyond;
    }
    return static_cast<double>(beyond) / static_cast<double>(points.size());
}

/** Adds up how much of a surface is near the map. */
class Coverage {
  public:
    Coverage(const Points& map, double distance_m, const SurfaceSight* sight)
        : tree_(map), distance_m_(distance_m), sight_(sight) {}

    void sample(const Eigen::Vector3d& p, double area) {
        ++samples_;
        total_ += area;
        const bool covered = tree_.distanceTo(p) <= distance_m_;
        if (covered) covered_ += area;
        if (!sight_ || !sight_->sees(p)) return;
        seen_ += area;
        if (covered) seen_covered_ += area;
    }

    double share() const { return total_ > 0 ? covered_ / total_ : 0; }
    std::optional<double> shareOfSeen() const {
        return seen_ > 0 ? std::optional<double>(seen_covered_ / seen_) : std::nullopt;
    }
    std::size_t samples() const { return samples_; }

  private:
    PointTree tree_;
    double distance_m_;
    const SurfaceSight* sight_;
    double covered_ = 0, total_ = 0, seen_covered_ = 0, seen_ = 0;
    std::size_t samples_ = 0;
};

}  // namespace

MapAccuracy evaluateMap(const PlyModel& map, const PlyModel& surface,
                        const MapAccuracyOptions& options) {
    check(map, options);
    const Points points = alignedPoints(map, options.alignment);
    const auto distances_m = distancesToSurface(points, surface);
    MapAccuracy accuracy;
    accuracy.distance_m = statisticsOf(distances_m);
    accuracy.distance_95_m = percentileOf(distances_m, 0.95);
    accuracy.beyond = shareBeyond(points, distances_m, options.beyond_m,
                                  [](const Eigen::Vector3d&) { return true; });
    if (options.movers) {
        accuracy.on_movers_ways =
            shareBeyond(points, distances_m, options.beyond_m,
                        [&](const Eigen::Vector3d& p) { return options.movers->contains(p); });
    }
    Coverage coverage(points, options.completeness_distance_m, options.sight);
    forEachSurfaceSample(surface, options.sample_spacing_m,
                         [&](const Eigen::Vector3d& p, double area) { coverage.sample(p, area); });
    accuracy.completeness = coverage.share();
    accuracy.completeness_of_seen = coverage.shareOfSeen();
    accuracy.surface_samples = coverage.samples();
    return accuracy;
}

}  // namespace rgbd_graphslam
