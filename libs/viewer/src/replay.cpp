#include "rgbd_graphslam/viewer/replay.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** How many elements of a list in order of time are not later than the stamp. */
template <class List>
std::size_t countUntil(const List& list, double stamp_s) {
    const auto end = std::upper_bound(list.begin(), list.end(), stamp_s,
                                      [](double s, const auto& e) { return s < e.stamp_s; });
    return static_cast<std::size_t>(end - list.begin());
}

/** How many edges have both ends among the first keyframes. */
std::size_t countAmong(const std::vector<KeyframeEdge>& edges, std::size_t keyframes) {
    const auto end = std::partition_point(edges.begin(), edges.end(), [&](const KeyframeEdge& e) {
        return static_cast<std::size_t>(std::max(e.from, e.to)) < keyframes;
    });
    return static_cast<std::size_t>(end - edges.begin());
}

}  // namespace

ReplayState replayAt(const RunData& run, double stamp_s) {
    ReplayState state;
    state.poses = countUntil(run.trajectory, stamp_s);
    state.keyframes = countUntil(run.keyframes, stamp_s);
    state.frames = countUntil(run.frames, stamp_s);
    state.loops = countAmong(run.loops, state.keyframes);
    state.covisibility = countAmong(run.covisibility, state.keyframes);
    return state;
}

std::pair<double, double> timeSpan(const RunData& run) {
    if (run.trajectory.empty()) return {0, 0};
    return {run.trajectory.front().stamp_s, run.trajectory.back().stamp_s};
}

std::optional<SE3> poseNear(const Trajectory& trajectory, double stamp_s) {
    if (trajectory.empty()) return std::nullopt;
    return poseAt(trajectory,
                  std::clamp(stamp_s, trajectory.front().stamp_s, trajectory.back().stamp_s));
}

}  // namespace rgbd_graphslam
