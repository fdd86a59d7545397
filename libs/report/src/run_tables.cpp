#include "run_tables.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/metrics/statistics.h"
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
        loop.error_m ? figureText(1e3 * *loop.error_m) + " mm" : std::string("not known");
    return formatted(
        "<tr%s><td>%d and %d</td><td>%.1f s and %.1f s</td><td>%d</td><td>%s</td></tr>\n",
        is_false ? " class=\"false\"" : "", loop.from, loop.to, seconds(loop.from),
        seconds(loop.to), loop.inliers, (error + (is_false ? ", false" : "")).c_str());
}

/** A line of the list. \param html value */
std::string fact(const char* name, const std::string& html) {
    if (html.empty()) return {};
    return std::string("<dt>") + name + "</dt><dd>" + html + "</dd>\n";
}

std::string code(const std::string& text) {
    return text.empty() ? text : "<code>" + htmlEscaped(text) + "</code>";
}

std::string lensText(const Lens& lens) {
    const std::string model = lensModel(lens);
    if (model == "none") return "pinhole";
    if (model == "plumb_bob") return "pinhole with Brown-Conrady distortion";
    return model == "rational" ? "pinhole with rational distortion" : "Kannala-Brandt fisheye";
}

std::string intrinsicsText(const Intrinsics& camera) {
    std::string text = formatted("fx %.2f, fy %.2f, cx %.2f, cy %.2f px", camera.fx, camera.fy,
                                 camera.cx, camera.cy);
    if (!camera.hasDistortion()) return text + "; no lens distortion";
    const bool is_fisheye = std::holds_alternative<KannalaBrandtLens>(camera.lens);
    const std::vector<const char*> names =
        is_fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
                   : std::vector<const char*>{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
    const std::vector<double> k = lensCoefficients(camera.lens);
    for (std::size_t i = 0; i < k.size(); ++i)
        text += formatted("%s %s %.4g", i == 0 ? ";" : ",", names[i], k[i]);
    return text;
}

}  // namespace

std::string figureText(double value) {
    const double size = std::abs(value);
    if (size >= 99.95) return formatted("%.0f", value);
    return formatted(size >= 0.995 ? "%.1f" : "%.2f", value);
}

std::string aboutTable(const RunRecord& run) {
    std::string html = fact("recording", code(run.rawlog)) +
                       fact("command", code(run.origin.command)) +
                       fact("date", htmlEscaped(run.origin.date)) +
                       fact("version", "rgbd-slam " + htmlEscaped(run.version)) +
                       fact("settings", "config.ini, hash " + code(run.config_hash));
    if (const auto& camera = run.origin.camera) {
        html += fact("camera", formatted("%d x %d px, ", camera->width, camera->height) +
                                   lensText(camera->lens));
        html += fact("intrinsics", intrinsicsText(*camera));
    }
    return "<dl class=\"facts\">\n" + html + "</dl>\n";
}

std::string loopTable(const RunRecord& run) {
    if (run.loops.empty()) return {};
    auto loops = worstFirst(run.loops);
    loops.resize(std::min(loops.size(), most_loops));
    std::string html =
        "<div class=\"scroll\"><table><tr><th>keyframes</th><th>seen at</th><th>inliers</th>"
        "<th>error</th></tr>\n";
    for (std::size_t i = 0; i < loops.size(); ++i) {
        html += loopRow(run, loops[i], i < run.false_loops.value_or(0));
    }
    return html + "</table></div>";
}

std::string loopSummary(const RunRecord& run) {
    std::vector<double> errors_mm;
    for (const LoopRecord& loop : run.loops) {
        if (loop.error_m) errors_mm.push_back(1e3 * *loop.error_m);
    }
    if (errors_mm.empty()) return "Without ground truth the loops cannot be checked.";
    const Statistics errors = statisticsOf(errors_mm);
    std::string text = formatted(
        "The error is that of the measured position of one keyframe relative to the other. "
        "Compared with ground truth (known for %zu of %zu loops) it is %s mm in the median and %s "
        "mm at most; %s.",
        errors_mm.size(), run.loops.size(), figureText(errors.median).c_str(),
        figureText(errors.max).c_str(),
        run.false_loops.value_or(0) == 0 ? "no loop is false"
                                         : "those marked false join different places");
    if (run.loops.size() > most_loops)
        text += formatted(" The table lists the %zu worst.", most_loops);
    return text;
}

std::string stageTable(const RunRecord& run) {
    double all_ms = 1e-9, most_ms = 1e-9;
    for (const StageRecord& stage : run.stages) {
        all_ms += totalMs(stage);
        most_ms = std::max(most_ms, totalMs(stage));
    }
    std::string html =
        "<div class=\"scroll\"><table><tr><th>stage</th><th>calls</th><th>mean</th>"
        "<th>median</th><th>95 %</th><th>max</th><th>share</th><th class=\"bar\"></th></tr>\n";
    for (const StageRecord& stage : run.stages) {
        html +=
            "<tr><td>" + htmlEscaped(stage.name) + "</td>" + formatted("<td>%zu</td>", stage.calls);
        for (const double ms : {stage.mean_ms, stage.median_ms, stage.p95_ms, stage.max_ms})
            html += "<td>" + figureText(ms) + "</td>";
        html += formatted(
            "<td>%.0f %%</td><td class=\"bar\"><i style=\"width:%.1f%%\"></i></td></tr>\n",
            100 * totalMs(stage) / all_ms, 100 * totalMs(stage) / most_ms);
    }
    return html + "</table></div>";
}

std::string sensorTable(const RunRecord& run) {
    if (run.sensors.empty()) return {};
    std::string html =
        "<div class=\"scroll\"><table><tr><th>sensor</th><th>used</th><th>rate</th>"
        "<th>longest gap</th><th>residual</th><th>over sigma</th><th>used for</th></tr>\n";
    for (const SensorUse& sensor : run.sensors) {
        html += "<tr><td>" + htmlEscaped(sensor.label + " (" + sensor.class_name + ")") + "</td>" +
                formatted("<td>%zu of %zu</td><td>%.1f Hz</td><td>%.2f s</td>", sensor.used,
                          sensor.readings, sensor.rate_hz, sensor.longest_gap_s);
        html += "<td>" + (sensor.residual_m ? formatted("%.3f m", *sensor.residual_m) : "") +
                "</td><td>" + (sensor.whitened ? formatted("%.2f", *sensor.whitened) : "") +
                "</td><td>" + htmlEscaped(sensor.use) + "</td></tr>\n";
    }
    return html + "</table></div>";
}

}  // namespace rgbd_graphslam
