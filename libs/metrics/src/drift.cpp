#include "rgbd_graphslam/metrics/drift.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"
#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

constexpr double degrees_per_radian = 180 / M_PI;
constexpr double longest_short_way_m = 200;

/** Poses at the same moments. */
struct Matched {
    Trajectory estimate, truth;
};

Matched match(const Trajectory& estimate, const Trajectory& truth, const DriftOptions& options) {
    Matched matched;
    for (const auto& [i, j] : associate(stampsOf(truth), stampsOf(estimate),
                                        options.max_difference_s, options.offset_s)) {
        matched.truth.push_back(truth[i]);
        matched.estimate.push_back(estimate[j]);
    }
    return matched;
}

std::vector<double> wayAlong(const Trajectory& path) {
    std::vector<double> way{0};
    for (std::size_t i = 1; i < path.size(); ++i) {
        way.push_back(way.back() + (path[i].T_world_cam.t - path[i - 1].T_world_cam.t).norm());
    }
    return way;
}

/** Those wanted that are no longer than the way. */
std::vector<double> lengthsFor(double way_m, const std::vector<double>& wanted) {
    constexpr int count = 8;
    std::vector<double> lengths = wanted;
    const double step_m = way_m < longest_short_way_m ? way_m / (count + 1) : 100;
    for (int i = 1; wanted.empty() && i <= count; ++i) lengths.push_back(i * step_m);
    lengths.erase(std::remove_if(lengths.begin(), lengths.end(),
                                 [&](double length) { return !(length > 0 && length < way_m); }),
                  lengths.end());
    return lengths;
}

SE3 motion(const Trajectory& path, std::size_t from, std::size_t to) {
    return path[from].T_world_cam.inverse() * path[to].T_world_cam;
}

DriftError errorOf(const Matched& matched, std::size_t from, std::size_t to, double length_m,
                   double scale) {
    SE3 estimated = motion(matched.estimate, from, to);
    estimated.t *= scale;
    const SE3 rest = estimated.inverse() * motion(matched.truth, from, to);
    return {matched.truth[from].stamp_s, matched.truth[to].stamp_s, length_m,
            100 * rest.t.norm() / length_m, degrees_per_radian * rest.angle() / length_m};
}

void addErrors(const Matched& matched, const std::vector<double>& way, double length_m,
               DriftResult& result) {
    for (std::size_t from = 0; from < way.size(); ++from) {
        const auto end = std::upper_bound(way.begin(), way.end(), way[from] + length_m);
        if (end == way.end()) return;
        result.errors.push_back(errorOf(matched, from, static_cast<std::size_t>(end - way.begin()),
                                        length_m, result.scale));
    }
}

double scaleFor(const Trajectory& estimate, const Trajectory& truth, const DriftOptions& options) {
    if (!options.fit_scale) return options.scale;
    AteOptions ate;
    ate.offset_s = options.offset_s;
    ate.max_difference_s = options.max_difference_s;
    return evaluateAte(estimate, truth, ate).fitted_scale.value_or(1);
}

void summarize(DriftResult& result) {
    std::vector<double> translation, rotation;
    for (const DriftError& error : result.errors) {
        translation.push_back(error.translation_percent);
        rotation.push_back(error.rotation_deg_m);
    }
    result.translation_percent = statisticsOf(translation);
    result.rotation_deg_m = statisticsOf(rotation);
}

}  // namespace

DriftResult evaluateDrift(const Trajectory& estimate, const Trajectory& truth,
                          const DriftOptions& options) {
    checkScale(options.scale);
    const auto poses = withUniqueStamps(estimate), true_poses = withUniqueStamps(truth);
    const Matched matched = match(poses, true_poses, options);
    if (matched.truth.size() < 2) {
        throw Error("drift needs two poses or more that match: " + spansOf(poses, true_poses),
                    "check that the files belong together, give --offset or --max-difference");
    }
    const std::vector<double> way = wayAlong(matched.truth);
    DriftResult result;
    result.estimate_poses = poses.size();
    result.matched_poses = matched.truth.size();
    result.scale = scaleFor(poses, true_poses, options);
    result.lengths_m = lengthsFor(way.back(), options.lengths_m);
    for (const double length_m : result.lengths_m) addErrors(matched, way, length_m, result);
    if (result.errors.empty()) {
        throw Error(
            "the true way of " + std::to_string(way.back()) + " m is shorter than every length",
            "give shorter ones with --lengths");
    }
    summarize(result);
    return result;
}

}  // namespace rgbd_graphslam
