#include "rgbd_graphslam/job/run_quality.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

constexpr double degrees_per_rad = 180 / M_PI;

/** Whether the chain of keyframes from the first to the last is torn. */
bool isBroken(const std::vector<Keyframe>& keyframes, std::size_t first, std::size_t last) {
    const auto begin = keyframes.begin();
    return std::any_of(begin + static_cast<std::ptrdiff_t>(first) + 1,
                       begin + static_cast<std::ptrdiff_t>(last) + 1,
                       [](const Keyframe& keyframe) { return keyframe.link == Link::None; });
}

}  // namespace

RunQuality frameQuality(const std::vector<TrackedFrame>& frames) {
    RunQuality quality;
    if (frames.empty()) return quality;
    const auto share = [&](FrameOrigin origin) {
        const auto count = std::count_if(frames.begin(), frames.end(),
                                         [&](const auto& frame) { return frame.origin == origin; });
        return static_cast<double>(count) / static_cast<double>(frames.size());
    };
    quality.tracked = share(FrameOrigin::Tracked);
    quality.recovered = share(FrameOrigin::Recovered);
    quality.dead_reckoned = share(FrameOrigin::DeadReckoned);
    quality.lost = share(FrameOrigin::Lost);
    std::vector<double> inliers;
    for (const TrackedFrame& frame : frames) {
        if (frame.origin != FrameOrigin::Lost) inliers.push_back(frame.inliers);
    }
    if (inliers.empty()) return quality;
    quality.inliers_median = percentileOf(inliers, 0.5);
    quality.inliers_p05 = percentileOf(inliers, 0.05);
    return quality;
}

std::optional<LoopResiduals> loopResiduals(const std::vector<PoseEdge>& loops,
                                           const std::vector<KeyframeView>& keyframes) {
    if (loops.empty()) return std::nullopt;
    std::vector<double> meters, degrees;
    for (const PoseEdge& loop : loops) {
        const SE3 T_from_to = keyframes[static_cast<std::size_t>(loop.from)].T_world_cam.inverse() *
                              keyframes[static_cast<std::size_t>(loop.to)].T_world_cam;
        const SE3 residual = loop.T_from_to.inverse() * T_from_to;
        meters.push_back(residual.t.norm());
        degrees.push_back(degrees_per_rad * residual.angle());
    }
    return LoopResiduals{percentileOf(meters, 0.5), percentileOf(meters, 1),
                         percentileOf(degrees, 0.5), percentileOf(degrees, 1)};
}

std::optional<DriftBeforeLoops> driftBeforeLoops(const std::vector<PoseEdge>& loops,
                                                 const Trajectory& before_loops,
                                                 const std::vector<Keyframe>& keyframes) {
    if (loops.empty() || before_loops.empty()) return std::nullopt;
    std::vector<double> way_m{0};
    for (std::size_t k = 1; k < before_loops.size(); ++k) {
        way_m.push_back(way_m.back() +
                        (before_loops[k].T_world_cam.t - before_loops[k - 1].T_world_cam.t).norm());
    }
    std::optional<DriftBeforeLoops> worst;
    for (const PoseEdge& loop : loops) {
        const auto from = static_cast<std::size_t>(loop.from),
                   to = static_cast<std::size_t>(loop.to);
        if (isBroken(keyframes, std::min(from, to), std::max(from, to))) continue;
        const SE3 T_from_to =
            before_loops[from].T_world_cam.inverse() * before_loops[to].T_world_cam;
        const double gap_m = (T_from_to.t - loop.T_from_to.t).norm();
        if (!worst || gap_m > worst->gap_m) worst = {gap_m, std::abs(way_m[to] - way_m[from])};
    }
    return worst;
}

std::string rollingShutterFinding(const RunQuality& quality) {
    if (!quality.readout || !isRollingShutter(*quality.readout)) return {};
    return formatted(
        "the camera has a rolling shutter: its rows are read over %.0f ms (+-%.1f), "
        "which bends fast motion; move more slowly, or use a camera with a global "
        "shutter",
        1e3 * std::abs(quality.readout->seconds), 1e3 * quality.readout->sigma_s);
}

std::string qualityText(const RunQuality& quality) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (quality.spread) {
        add(formatted("surfaces agree within %.1f mm (95 %%: %.1f mm)",
                      1e3 * quality.spread->median_m, 1e3 * quality.spread->p95_m));
    }
    if (quality.loops) add(formatted("loops within %.1f mm", 1e3 * quality.loops->median_m));
    if (quality.drift) {
        add(formatted("drift before loops %.3f m (%.1f %%)", quality.drift->gap_m,
                      100 * quality.drift->share()));
    }
    add(formatted("%.0f inliers", quality.inliers_median));
    if (quality.depth_median) {
        add(formatted("%.0f %% of the pixels have depth", 100 * *quality.depth_median));
    }
    return text;
}

}  // namespace rgbd_graphslam
