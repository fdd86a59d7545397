#include "rgbd_graphslam/laser/aperture_check.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/laser/correlation_field.h"
#include "rgbd_graphslam/laser/scan_alignment.h"

namespace rgbd_graphslam {
namespace {

constexpr double degree = M_PI / 180;
constexpr double farthest_m = 30;

using Scan = mrpt::obs::CObservation2DRangeScan;

PlanarScan planar(const Scan& scan, double factor) {
    Scan other = scan;
    other.aperture *= static_cast<float>(factor);
    return toPlanarScan(other, 0.1, farthest_m);
}

struct Turn {
    const PlacedScan *from, *to;
};

/** Pairs between which the robot turned visibly and hardly moved, spread over the recording. */
std::vector<Turn> turnsOf(const std::vector<PlacedScan>& scans) {
    constexpr std::size_t most = 60, most_steps = 10;
    constexpr double least_rad = 5 * degree, largest_rad = 25 * degree, farthest_way_m = 0.5;
    std::vector<Turn> all;
    for (std::size_t i = 0; i + 1 < scans.size(); ++i) {
        for (std::size_t j = i + 1; j < std::min(scans.size(), i + most_steps); ++j) {
            const PlanarPose moved = scans[i].T_start_base.inverse() * scans[j].T_start_base;
            const double turn = std::abs(wrapped(moved.yaw));
            if (turn < least_rad) continue;
            if (turn < largest_rad && positionOf(moved).norm() < farthest_way_m) {
                all.push_back({&scans[i], &scans[j]});
            }
            i = j;
            break;
        }
    }
    std::vector<Turn> chosen;
    const std::size_t step = std::max<std::size_t>(1, all.size() / most);
    for (std::size_t k = 0; k < all.size(); k += step) chosen.push_back(all[k]);
    return chosen;
}

/** Turn by the scans, searched for from none to twice what the wheels tell. */
std::optional<double> turnByScans(const Turn& turn, double factor) {
    constexpr double least_share = 0.5;
    const PlanarScan from = planar(*turn.from->scan, factor), to = planar(*turn.to->scan, factor);
    if (from.points.empty() || to.points.empty()) return std::nullopt;
    const PlanarPose moved = turn.from->T_start_base.inverse() * turn.to->T_start_base;
    const CorrelationField field(from.points, 0.05, 0.08);
    const auto found =
        field.match(to.points, moved, {0.3, 1.3 * std::abs(wrapped(moved.yaw)), 1 * degree});
    if (!found) return std::nullopt;
    const auto aligned =
        alignScan(PointIndex(from.points), to.points, found->T_ref_scan, std::nullopt, {});
    if (!aligned || aligned->inlier_share < least_share) return std::nullopt;
    return wrapped(aligned->T_ref_scan.yaw);
}

/** Median of turns by scans over turns by wheels; nothing with too few turns. */
std::optional<double> turnRatio(const std::vector<Turn>& turns, double factor) {
    constexpr std::size_t least_turns = 5;
    std::vector<double> ratios;
    for (const Turn& turn : turns) {
        const auto by_scans = turnByScans(turn, factor);
        const PlanarPose moved = turn.from->T_start_base.inverse() * turn.to->T_start_base;
        if (by_scans) ratios.push_back(*by_scans / wrapped(moved.yaw));
    }
    if (ratios.size() < least_turns) return std::nullopt;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
}

/** Deviation of points from their line, over their length. */
double bend(const std::vector<Eigen::Vector2d>& points) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& p : points) spread += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, axes.eigenvalues()(0)) / axes.eigenvalues()(1));
}

/** How bent the straightest tenth of all surfaces over a quarter of the view is. */
double wallBend(const std::vector<PlacedScan>& scans, double factor) {
    constexpr std::size_t most_scans = 200, parts = 4;
    constexpr double most_jump_share = 0.1;
    std::vector<double> bends;
    const std::size_t step = std::max<std::size_t>(1, scans.size() / most_scans);
    for (std::size_t s = 0; s < scans.size(); s += step) {
        const auto points = planar(*scans[s].scan, factor).points;
        const std::size_t length = scans[s].scan->getScanSize() / parts;
        std::vector<Eigen::Vector2d> run;
        for (const ScanPoint& point : points) {
            const bool jumps = !run.empty() && (point.p - run.back()).norm() >
                                                   most_jump_share * (0.5 + point.p.norm());
            if (jumps) run.clear();
            run.push_back(point.p);
            if (run.size() < std::max<std::size_t>(length, 8)) continue;
            bends.push_back(bend(run));
            run.clear();
        }
    }
    if (bends.empty()) return 1;
    const auto tenth = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 10);
    std::nth_element(bends.begin(), tenth, bends.end());
    return *tenth;
}

bool isRight(double ratio) {
    return ratio > 0.8 && ratio < 1.25;
}

}  // namespace

ApertureVerdict checkAperture(const std::vector<PlacedScan>& scans) {
    ApertureVerdict verdict;
    const std::vector<Turn> turns = turnsOf(scans);
    const auto recorded = turnRatio(turns, 1);
    if (!recorded) return verdict;
    verdict.turn_ratio = *recorded;
    if (isRight(*recorded)) return verdict;
    const Scan& scan = *scans.front().scan;
    const double aperture_deg = scan.aperture / degree, bent = wallBend(scans, 1);
    for (const double factor : {2.0, 0.5}) {
        if (factor * aperture_deg > 361) continue;
        const auto ratio = turnRatio(turns, factor);
        if (!ratio || !isRight(*ratio) || wallBend(scans, factor) > 0.8 * bent) continue;
        verdict.factor = factor;
        verdict.warning = formatted(
            "the aperture of the laser '%s' is recorded as %.0f degrees, but walls are straight "
            "and turns are those of the wheels with %.0f: using %.0f",
            scan.sensorLabel.c_str(), aperture_deg, factor * aperture_deg, factor * aperture_deg);
        return verdict;
    }
    verdict.warning = formatted(
        "scans of the laser '%s' turn %.2f times as far as the odometry: check the aperture "
        "(recorded as %.0f degrees), the sensorPose and the unit of the odometry's heading",
        scan.sensorLabel.c_str(), *recorded, aperture_deg);
    return verdict;
}

}  // namespace rgbd_graphslam
