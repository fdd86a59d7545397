#include "loop_verification.h"

#include <cmath>

#include "scan_bundle.h"

namespace rgbd_graphslam {
namespace {

constexpr double wide_window_m = 0.75;

/** Of the scan's beams in the frame that they are checked in. */
bool contradicts(const CorrelationField& field, const PlanarScan& scan, const PlanarPose& T) {
    constexpr double most = 0.12;
    std::vector<Eigen::Vector2d> ends;
    for (const ScanPoint& point : scan.points) ends.push_back(transformed(T, point.p));
    return field.contradiction(transformed(T, scan.origin), ends) > most;
}

struct Places {
    std::vector<ScanPoint> reference, query;
};

/** The older scans in the frame of `old`, and the last ones in that of `now`. */
Places placesOf(const std::vector<Keyscan>& keyscans, int old, int now) {
    constexpr int most_old = 12, most_new = 5;
    constexpr double way_old_m = 6, way_new_m = 2.5, spacing_m = 0.1;
    const ScanSpan olds = spanAround(keyscans, old, most_old, way_old_m);
    const int first_new = spanAround(keyscans, now, most_new, way_new_m).first;
    const int last_old = std::min(olds.last, first_new - 1);
    return {bundle(keyscans, olds.first, last_old, old),
            spacedOut(bundle(keyscans, first_new, now, now), spacing_m)};
}

AlignmentOptions alignmentOptions(double first_gate_m, const LaserOptions& options) {
    AlignmentOptions alignment;
    alignment.first_gate_m = first_gate_m;
    alignment.sigma_m = options.point_sigma_m;
    return alignment;
}

}  // namespace

std::optional<ScanLoop> verifiedLoop(const std::vector<Keyscan>& keyscans, int old, int now,
                                     const SearchWindow& window, const LaserOptions& options) {
    constexpr double narrow_cell_m = 0.05, wide_cell_m = 0.1, most_alike = 0.92;
    constexpr double first_gate_m = 0.3, farthest_refined_m = 0.5;
    const Places places = placesOf(keyscans, old, now);
    if (places.reference.empty()) return std::nullopt;
    const bool is_wide = window.xy_m > wide_window_m;
    const double cell_m = is_wide ? wide_cell_m : narrow_cell_m;
    const CorrelationField field(places.reference, cell_m, 1.5 * cell_m);
    const PlanarPose guess = keyscans[old].T_world_base.inverse() * keyscans[now].T_world_base;
    const auto found = field.match(places.query, guess, window);
    if (!found || (is_wide && found->runner_up > most_alike * found->score)) return std::nullopt;
    const auto aligned = alignScan(PointIndex(places.reference), places.query, found->T_ref_scan,
                                   std::nullopt, alignmentOptions(first_gate_m, options));
    if (!aligned || aligned->inlier_share < options.loop_min_overlap) return std::nullopt;
    const PlanarPose& T_old_now = aligned->T_ref_scan;
    if ((positionOf(T_old_now) - positionOf(found->T_ref_scan)).norm() > farthest_refined_m)
        return std::nullopt;
    const CorrelationField around_now(places.query, cell_m, 1.5 * cell_m);
    if (contradicts(field, keyscans[now].scan, T_old_now) ||
        contradicts(around_now, keyscans[old].scan, T_old_now.inverse())) {
        return std::nullopt;
    }
    return ScanLoop{old, now, *aligned};
}

std::optional<ScanLoop> neighborAlignment(const std::vector<Keyscan>& keyscans, int old, int now,
                                          const LaserOptions& options) {
    constexpr int most = 3;
    constexpr double way_m = 1.5, first_gate_m = 0.3, least_share = 0.5;
    constexpr double farthest_m = 0.25, farthest_rad = 0.06;
    const ScanSpan span = spanAround(keyscans, old, most, way_m);
    const PlanarPose guess = keyscans[old].T_world_base.inverse() * keyscans[now].T_world_base;
    const auto aligned = alignScan(PointIndex(bundle(keyscans, span.first, span.last, old)),
                                   keyscans[now].scan.points, guess, std::nullopt,
                                   alignmentOptions(first_gate_m, options));
    if (!aligned || aligned->inlier_share < least_share) return std::nullopt;
    const PlanarPose moved = guess.inverse() * aligned->T_ref_scan;
    if (positionOf(moved).norm() > farthest_m || std::abs(wrapped(moved.yaw)) > farthest_rad)
        return std::nullopt;
    return ScanLoop{old, now, *aligned};
}

}  // namespace rgbd_graphslam
