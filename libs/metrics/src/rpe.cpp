#include "rgbd_graphslam/metrics/rpe.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

constexpr double degrees_per_radian = 180 / M_PI;
constexpr std::size_t no_truth = -1;

using Pair = std::pair<std::size_t, std::size_t>;

/** Uniform in [0, bound) by rejection; std::uniform_int_distribution differs between libraries. */
std::size_t below(std::size_t bound, std::mt19937_64& random) {
    constexpr std::uint64_t largest = std::mt19937_64::max();
    const std::uint64_t usable = largest - largest % bound;
    std::uint64_t drawn = random();
    while (drawn >= usable) drawn = random();
    return drawn % bound;
}

/** \param weight_of length of a step of the path */
template <class Weight>
std::vector<double> sumsAlong(const Trajectory& path, Weight weight_of) {
    std::vector<double> sums{0};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const SE3 step = path[i - 1].T_world_cam.inverse() * path[i].T_world_cam;
        sums.push_back(sums.back() + weight_of(step));
    }
    return sums;
}

/** Where each pose is on the path, in the unit of the delta; ascending. */
std::vector<double> placesOnPath(const Trajectory& path, DeltaUnit unit) {
    const auto angle = [](const SE3& step) { return step.angle(); };
    const auto degrees = [](const SE3& step) { return step.angle() * degrees_per_radian; };
    const auto length = [](const SE3& step) { return step.t.norm(); };
    switch (unit) {
        case DeltaUnit::Seconds:
            return stampsOf(path);
        case DeltaUnit::Meters:
            return sumsAlong(path, length);
        case DeltaUnit::Radians:
            return sumsAlong(path, angle);
        case DeltaUnit::Degrees:
            return sumsAlong(path, degrees);
        case DeltaUnit::Frames:
            break;
    }
    std::vector<double> frames(path.size());
    std::iota(frames.begin(), frames.end(), 0.0);
    return frames;
}

/** Keeps `count` of the pairs, each with the same chance. */
void thin(std::vector<Pair>& pairs, std::size_t count, std::mt19937_64& random) {
    for (std::size_t k = 0; k < count; ++k) {
        std::swap(pairs[k], pairs[k + below(pairs.size() - k, random)]);
    }
    pairs.resize(count);
}

/** Pairs that would need a pose past the end, for which the last pose is the nearest, are left
 *  out. */
std::vector<Pair> pairsApart(const Trajectory& path, const RpeOptions& options) {
    const auto places = placesOnPath(path, options.unit);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const std::size_t j = nearestIndex(places, places[i] + options.delta);
        if (j + 1 != path.size()) pairs.emplace_back(i, j);
    }
    return pairs;
}

std::vector<Pair> allPairs(std::size_t poses) {
    std::vector<Pair> pairs;
    pairs.reserve(poses * poses);
    for (std::size_t i = 0; i < poses; ++i) {
        for (std::size_t j = 0; j < poses; ++j) pairs.emplace_back(i, j);
    }
    return pairs;
}

std::vector<Pair> drawnPairs(std::size_t poses, std::size_t count, std::mt19937_64& random) {
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = below(poses, random), j = below(poses, random);
        pairs.emplace_back(i, j);
    }
    return pairs;
}

std::vector<Pair> choosePairs(const Trajectory& path, const RpeOptions& options) {
    std::mt19937_64 random(options.seed);
    if (!options.fixed_delta) {
        const bool all = options.max_pairs == 0 || path.size() * path.size() < options.max_pairs;
        return all ? allPairs(path.size()) : drawnPairs(path.size(), options.max_pairs, random);
    }
    auto pairs = pairsApart(path, options);
    if (options.max_pairs != 0 && pairs.size() > options.max_pairs) {
        thin(pairs, options.max_pairs, random);
    }
    return pairs;
}

double medianInterval(const std::vector<double>& stamps_s) {
    std::vector<double> intervals(stamps_s.size());
    std::adjacent_difference(stamps_s.begin(), stamps_s.end(), intervals.begin());
    intervals.erase(intervals.begin());
    return percentileOf(std::move(intervals), 0.5);
}

/** For each pose of the estimate the index of its truth, or no_truth. */
std::vector<std::size_t> nearestTruths(const Trajectory& estimate, const Trajectory& truth,
                                       double offset_s) {
    const auto truth_s = stampsOf(truth);
    const double largest_difference_s = 2 * medianInterval(truth_s);
    std::vector<std::size_t> nearest;
    for (const double stamp_s : stampsOf(estimate)) {
        const double wanted_s = stamp_s + offset_s;
        const std::size_t i = nearestIndex(truth_s, wanted_s);
        const bool near = std::abs(truth_s[i] - wanted_s) <= largest_difference_s;
        nearest.push_back(near ? i : no_truth);
    }
    return nearest;
}

/** Motion from pose b to pose a, seen from a. */
SE3 motionBetween(const StampedPose& a, const StampedPose& b, double scale) {
    SE3 motion = a.T_world_cam.inverse() * b.T_world_cam;
    motion.t *= scale;
    return motion;
}

RelativeError errorOf(const StampedPose& from, const StampedPose& to, const StampedPose& true_from,
                      const StampedPose& true_to, double scale) {
    // The order of the tools: what is left of the true motion back from `to` to `from`.
    const SE3 rest =
        motionBetween(to, from, scale).inverse() * motionBetween(true_to, true_from, 1);
    return {from.stamp_s, to.stamp_s, rest.t, rotationLog(rest.R)};
}

std::vector<RelativeError> errorsOf(const Trajectory& estimate, const Trajectory& truth,
                                    const std::vector<std::size_t>& truth_of,
                                    const RpeOptions& options) {
    std::vector<RelativeError> errors;
    for (const auto& [i, j] : choosePairs(estimate, options)) {
        if (truth_of[i] == no_truth || truth_of[j] == no_truth) continue;
        errors.push_back(errorOf(estimate[i], estimate[j], truth[truth_of[i]], truth[truth_of[j]],
                                 options.scale));
    }
    return errors;
}

void summarize(RpeResult& result) {
    std::vector<double> translation_m, rotation_deg;
    for (const auto& error : result.errors) {
        translation_m.push_back(error.translation_m.norm());
        rotation_deg.push_back(error.rotation_rad.norm() * degrees_per_radian);
    }
    result.translation_m = statisticsOf(translation_m);
    result.rotation_deg = statisticsOf(rotation_deg);
}

}  // namespace

RpeResult evaluateRpe(const Trajectory& estimate, const Trajectory& truth,
                      const RpeOptions& options) {
    checkScale(options.scale);
    const auto poses = withUniqueStamps(estimate), true_poses = withUniqueStamps(truth);
    if (poses.size() < 2 || true_poses.size() < 2) {
        throw Error("a relative error needs two poses or more: " + spansOf(poses, true_poses));
    }
    const auto truth_of = nearestTruths(poses, true_poses, options.offset_s);
    RpeResult result;
    result.estimate_poses = poses.size();
    result.matched_poses = poses.size() - std::count(truth_of.begin(), truth_of.end(), no_truth);
    result.errors = errorsOf(poses, true_poses, truth_of, options);
    if (result.errors.size() < 2) {
        throw Error(std::to_string(result.errors.size()) +
                        " pairs of poses have a truth: " + spansOf(poses, true_poses),
                    "check that the files belong together, give --offset or a smaller --delta");
    }
    summarize(result);
    return result;
}

}  // namespace rgbd_graphslam
