#include "run_tables.h"

#include <algorithm>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/evaluation/statistics.h"
#include "rgbd_graphslam/report/html.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most_loops = 12;

double totalMs(const StageRecord& stage) {
    return stage.mean_ms * static_cast<double>(stage.calls);
}

/** By falling error; those without one stay in their order behind. */
std::vector<LoopRecord> worstFirst(std::vector<LoopRecord> loops) {
    std::stable_sort(loops.begin(), loops.end(), [](const LoopRecord& a, const LoopRecord& b) {
        return a.error_m.value_or(-1) > b.error_m.value_or(-1);
    });
    return loops;
}

std::string loopRow(const RunRecord& run, const LoopRecord& loop, bool is_false) {
    const auto seconds = [&](int keyframe) {
        return run.keyframes[static_cast<std::size_t>(keyframe)].stamp_s - run.start_s;
    };
    const std::string error =
        loop.error_m ? formatted("%.1f mm", 1e3 * *loop.error_m) : std::string("not known");
    return formatted(
        "<tr%s><td>%d and %d</td><td>%.1f s and %.1f s</td><td>%d</td><td>%s</td></tr>\n",
        is_false ? " class=\"false\"" : "", loop.from, loop.to, seconds(loop.from),
        seconds(loop.to), loop.inliers, (error + (is_false ? ", false" : "")).c_str());
}

}  // namespace

std::string loopTable(const RunRecord& run) {
    if (run.loops.empty()) return {};
    auto loops = worstFirst(run.loops);
    loops.resize(std::min(loops.size(), most_loops));
    std::string html =
        "<table><tr><th>keyframes</th><th>seen at</th><th>landmarks that agree</th>"
        "<th>distance to the truth</th></tr>\n";
    for (std::size_t i = 0; i < loops.size(); ++i) {
        html += loopRow(run, loops[i], i < run.false_loops.value_or(0));
    }
    return html + "</table>";
}

std::string loopSummary(const RunRecord& run) {
    std::vector<double> errors_mm;
    for (const LoopRecord& loop : run.loops) {
        if (loop.error_m) errors_mm.push_back(1e3 * *loop.error_m);
    }
    if (errors_mm.empty()) return "Without ground truth the loops cannot be checked.";
    const Statistics errors = statisticsOf(errors_mm);
    std::string text = formatted(
        "A loop measures where one keyframe is from the other. Against the truth, known for %zu of "
        "%zu, it is off by %.1f mm in the median and %.1f mm at most; %s.",
        errors_mm.size(), run.loops.size(), errors.median, errors.max,
        run.false_loops.value_or(0) == 0 ? "none is false"
                                         : "those marked false join places that are not the same");
    if (run.loops.size() > most_loops)
        text += formatted(" The table shows the worst %zu.", most_loops);
    return text;
}

std::string stageTable(const RunRecord& run) {
    double all_ms = 1e-9, most_ms = 1e-9;
    for (const StageRecord& stage : run.stages) {
        all_ms += totalMs(stage);
        most_ms = std::max(most_ms, totalMs(stage));
    }
    std::string html =
        "<table><tr><th>stage</th><th>calls</th><th>mean</th><th>median</th><th>95 %</th>"
        "<th>max</th><th>share</th><th></th></tr>\n";
    for (const StageRecord& stage : run.stages) {
        html += "<tr><td>" + htmlEscaped(stage.name) + "</td>" +
                formatted(
                    "<td>%zu</td><td>%.2f</td><td>%.2f</td><td>%.2f</td><td>%.1f</td>"
                    "<td>%.0f %%</td><td class=\"bar\"><i style=\"width:%.1f%%\"></i></td></tr>\n",
                    stage.calls, stage.mean_ms, stage.median_ms, stage.p95_ms, stage.max_ms,
                    100 * totalMs(stage) / all_ms, 100 * totalMs(stage) / most_ms);
    }
    return html + "</table>";
}

}  // namespace rgbd_graphslam
