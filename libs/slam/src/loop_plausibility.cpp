#include "rgbd_graphslam/slam/loop_plausibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Disagreement of a loop with the map that needs no long path to explain. */
constexpr Drift least_drift{0.3, 0.3};
/** Between submaps. */
constexpr Drift any_drift{1e6, 1e6};
/** A weak link makes the way as unsure as this much of it. */
constexpr double dead_reckoned_link_m = 25;
/** Farther apart, two views have hardly a descriptor in common. */
constexpr Drift widest_view{4, 1.2};
/** A loop with fewer inliers than this share of the best one's is no contender. */
constexpr double contender_share = 0.5;
/** A loop is unheeded if the optimized graph leaves more than this of what it asked. */
constexpr double unheeded_m = 0.05, unheeded_share = 0.25;

}  // namespace

void LoopPlausibility::travelTo(int keyframe) {
    if (travelled_m_.empty()) travelled_m_.push_back(0);
    for (int k = static_cast<int>(travelled_m_.size()); k <= keyframe; ++k) {
        const SE3 step = map_.T_cam_world(k - 1) * map_.T_cam_world(k).inverse();
        const double unsure =
            map_.keyframe(k).link == Link::DeadReckoned ? dead_reckoned_link_m : 0;
        travelled_m_.push_back(travelled_m_.back() + step.t.norm() + unsure);
    }
}

/** Length of the shortest way between two keyframes along the robot's path, with one loop as a
 *  short cut: drift can only have gathered on it. */
double LoopPlausibility::pathLength(int from, int to) const {
    const auto along = [&](int a, int b) { return std::abs(travelled_m_[a] - travelled_m_[b]); };
    double shortest = along(from, to);
    for (const PoseEdge& loop : loops_) {
        shortest = std::min(shortest, along(from, loop.from) + along(loop.to, to));
    }
    return shortest;
}

Drift LoopPlausibility::greatestDrift(int from, int to) const {
    if (map_.keyframe(from).submap != map_.keyframe(to).submap) return any_drift;
    const double gathered = options_.max_drift_share * pathLength(from, to);
    return {least_drift.m + gathered, least_drift.rad + gathered};
}

bool LoopPlausibility::mightSee(int keyframe, int candidate) const {
    const SE3 apart = map_.T_cam_world(candidate) * map_.T_cam_world(keyframe).inverse();
    const Drift drift = greatestDrift(candidate, keyframe);
    return apart.t.norm() <= widest_view.m + drift.m &&
           apart.angle() <= widest_view.rad + drift.rad;
}

Drift LoopPlausibility::asked(const PoseEdge& loop) const {
    const SE3 T_from_to = map_.T_cam_world(loop.from) * map_.T_cam_world(loop.to).inverse();
    const SE3 move = loop.T_from_to.inverse() * T_from_to;
    return {move.t.norm(), move.angle()};
}

std::optional<VerifiedLoop> LoopPlausibility::likeliest(std::vector<VerifiedLoop> loops) const {
    int most_inliers = 0;
    for (const VerifiedLoop& loop : loops) most_inliers = std::max(most_inliers, loop.edge.inliers);
    std::optional<VerifiedLoop> best;
    double least_share = 1;
    for (VerifiedLoop& loop : loops) {
        if (loop.edge.inliers < contender_share * most_inliers) continue;
        const Drift greatest = greatestDrift(loop.edge.from, loop.edge.to);
        const double share = std::max(loop.asked.m / greatest.m, loop.asked.rad / greatest.rad);
        if (share > least_share) continue;
        least_share = share;
        best = std::move(loop);
    }
    return best;
}

bool LoopPlausibility::followed(const VerifiedLoop& loop) const {
    return asked(loop.edge).m < std::max(unheeded_m, unheeded_share * loop.asked.m);
}

void LoopPlausibility::save(ByteWriter& out) const {
    out.putCount(travelled_m_.size());
    for (const double m : travelled_m_) out.put(m);
}

void LoopPlausibility::load(ByteReader& in) {
    travelled_m_.resize(in.getCount(sizeof(double)));
    for (double& m : travelled_m_) m = getFinite(in);
}

}  // namespace rgbd_graphslam
