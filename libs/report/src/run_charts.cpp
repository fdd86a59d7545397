#include "run_charts.h"

#include <utility>

#include "rgbd_graphslam/report/run_findings.h"
#include "rgbd_graphslam/report/svg_chart.h"

namespace rgbd_graphslam {
namespace {

/** Every n-th pose, where there are more than a chart can show. */
Trajectory thinned(const Trajectory& poses) {
    constexpr std::size_t most = 3000;
    const std::size_t step = poses.size() / most + 1;
    Trajectory some;
    for (std::size_t i = 0; i < poses.size(); i += step) some.push_back(poses[i]);
    return some;
}

ChartLine pathOf(const std::string& name, const std::string& css_class, const Trajectory& poses) {
    ChartLine line{name, css_class, {}};
    for (const StampedPose& pose : thinned(poses)) {
        line.points.push_back(pose.T_world_cam.t.head<2>());
    }
    return line;
}

/** Cuts a line wherever a lost frame lies between two of its points, so that nothing is drawn that
 *  nobody saw. Only the first piece keeps the name.
 *  \param seconds of each point, since the first frame */
std::vector<ChartLine> withoutGaps(const ChartLine& line, const std::vector<double>& seconds,
                                   const std::vector<LostSpan>& lost) {
    std::vector<ChartLine> pieces{{line.name, line.css_class, {}}};
    auto gap = lost.begin();
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        bool cut = false;
        for (; gap != lost.end() && gap->first_s < seconds[i]; ++gap) cut = true;
        if (cut && i > 0) pieces.push_back({"", line.css_class, {}});
        pieces.back().points.push_back(line.points[i]);
    }
    return pieces;
}

/** Named pieces of a path, cut where frames were lost. */
std::vector<ChartLine> pathPieces(const RunRecord& run, const std::string& name,
                                  const std::string& css_class, const Trajectory& poses) {
    std::vector<double> seconds;
    for (const StampedPose& pose : thinned(poses)) seconds.push_back(pose.stamp_s - run.start_s);
    return withoutGaps(pathOf(name, css_class, poses), seconds, lostSpans(run.frames));
}

/** Keyframes of all sessions, with no line from one session to the next. Where frames of earlier
 *  ones were lost is not known. */
void addSessions(std::vector<ChartLine>& lines, const RunRecord& run, std::string name,
                 const std::string& css_class, const Trajectory& keyframes) {
    auto sessions = pieces(keyframes, run.earlier_keyframes);
    const Trajectory latest = std::move(sessions.back());
    sessions.pop_back();
    for (const Trajectory& session : sessions) {
        lines.push_back(pathOf(std::exchange(name, {}), css_class, session));
    }
    const auto drawn = pathPieces(run, name, css_class, latest);
    lines.insert(lines.end(), drawn.begin(), drawn.end());
}

}  // namespace

std::string pathChart(const RunRecord& run) {
    auto lines = pathPieces(run, "ground truth", "truth", run.truth);
    const auto estimate = pathPieces(run, "estimate", "estimate", run.trajectory);
    lines.insert(lines.end(), estimate.begin(), estimate.end());
    return planChart(lines);
}

std::string loopChart(const RunRecord& run) {
    if (run.loops.empty()) return {};
    std::vector<ChartLine> lines;
    addSessions(lines, run, "before loop closure", "before", run.keyframes_before_loops);
    addSessions(lines, run, "after loop closure", "after", run.keyframes);
    const auto at = [&](int keyframe) -> Eigen::Vector2d {
        return run.keyframes[static_cast<std::size_t>(keyframe)].T_world_cam.t.head<2>();
    };
    for (const LoopRecord& loop : run.loops) {
        const bool first = &loop == &run.loops.front();
        lines.push_back({first ? "loop" : "", "loop", {at(loop.from), at(loop.to)}});
    }
    return planChart(lines);
}

std::string errorChart(const RunRecord& run, const AteResult& ate) {
    ChartLine line{"", "value", {}};
    std::vector<double> seconds;
    for (const AtePair& pair : ate.pairs) {
        seconds.push_back(pair.stamp_s - run.start_s);
        line.points.emplace_back(seconds.back(), 1e3 * pair.error_m().norm());
    }
    return timeChart(withoutGaps(line, seconds, lostSpans(run.frames)), "position error [mm]");
}

std::string landmarkChart(const RunRecord& run) {
    ChartLine line{"", "value", {}};
    for (const ReportedFrame& frame : run.frames) {
        line.points.emplace_back(frame.seconds, frame.inliers);
    }
    std::vector<std::pair<double, double>> lost;
    for (const LostSpan& span : lostSpans(run.frames)) lost.emplace_back(span.first_s, span.last_s);
    return timeChart(
        {line}, lost.empty() ? "inliers per frame" : "inliers per frame; lost frames red", lost);
}

}  // namespace rgbd_graphslam
