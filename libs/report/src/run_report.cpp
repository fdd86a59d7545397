#include "rgbd_graphslam/report/run_report.h"

#include <algorithm>
#include <filesystem>

#include "page_template.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/report/html.h"
#include "rgbd_graphslam/report/run_findings.h"
#include "rgbd_graphslam/report/svg_chart.h"

namespace rgbd_graphslam {
namespace {

/** Nothing without content. \param title plain text \param content HTML */
std::string section(const std::string& title, const std::string& content,
                    const std::string& css_class = {}) {
    if (content.empty()) return {};
    return "<section class=\"" + css_class + "\"><h2>" + htmlEscaped(title) + "</h2>\n" + content +
           "</section>\n";
}

/** Nothing without a picture. \param picture HTML */
std::string figure(const std::string& picture, const std::string& caption,
                   const std::string& css_class = {}) {
    if (picture.empty()) return {};
    return "<figure class=\"" + css_class + "\">" + picture + "<figcaption>" +
           htmlEscaped(caption) + "</figcaption></figure>\n";
}

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

std::optional<AteResult> ateOf(const RunRecord& run) {
    if (run.truth.empty()) return std::nullopt;
    try {
        return evaluateAte(run.trajectory, run.truth);
    } catch (const Error&) {
        return std::nullopt;  // too few poses match to compare
    }
}

class Page {
  public:
    explicit Page(const RunRecord& run) : run_(run), ate_(ateOf(run)) {}

    std::string html() const {
        const std::string name = std::filesystem::path(run_.rawlog).filename().string();
        return filled(report_page, {{"title", htmlEscaped(name)},
                                    {"subtitle", subtitle()},
                                    {"figures", figures()},
                                    {"findings", findings()},
                                    {"sections", sections()}});
    }

  private:
    std::string subtitle() const {
        return "RGB-D SLAM of " + htmlEscaped(run_.rawlog) + " by rgbd-slam " +
               htmlEscaped(run_.version) + ", settings " + htmlEscaped(run_.config_hash) +
               " (config.ini)";
    }

    std::string figures() const {
        std::string html;
        const auto add = [&](const std::string& value, const char* what) {
            html += "<div><b>" + value + "</b><span>" + what + "</span></div>\n";
        };
        const std::size_t located = run_.frames.size() - run_.count(FrameState::Lost);
        add(std::to_string(located) + " / " + std::to_string(run_.frames.size()),
            "frames with a pose");
        if (!run_.frames.empty()) add(formatted("%.1f s", run_.frames.back().seconds), "recorded");
        add(formatted("%.2f m", run_.path_m), "path");
        add(std::to_string(run_.keyframes.size()), "keyframes");
        add(std::to_string(run_.loops.size()), "loops");
        add(std::to_string(run_.landmarks), "landmarks");
        if (ate_) add(formatted("%.1f mm", 1e3 * ate_->translation_m.rmse), "ATE RMSE");
        add(formatted("%.0f /s", run_.frames_per_s), "frames");
        add(formatted("%.1f ms", run_.cpu_ms_a_frame), "CPU a frame");
        add(formatted("%.0f MB", run_.peak_memory_mb), "peak memory");
        return html;
    }

    std::string findings() const {
        const auto found = findingsOf(run_, ate_);
        const bool warned = std::any_of(found.begin(), found.end(), [](const Finding& finding) {
            return finding.kind == Finding::Kind::Warning;
        });
        std::string html;
        if (!warned)
            html += "<li class=\"good\">every frame was tracked; nothing to warn of</li>\n";
        for (const Finding& finding : found) {
            html += finding.kind == Finding::Kind::Warning ? "<li class=\"warning\">" : "<li>";
            html += htmlEscaped(finding.text) + "</li>\n";
        }
        return html;
    }

    std::string sections() const {
        return section("Map from above", mapPicture()) +
               section("Obstacles and free space", grid()) + section("Path from above", path()) +
               section("Before and after loops", loops()) + section("Error over time", errors()) +
               section("Tracked landmarks", landmarks()) + section("Time by stage", stages()) +
               section("Keyframes", keyframes(), "wide");
    }

    std::string mapPicture() const {
        return figure(embeddedImage("image/png", run_.map_png, "map from above"),
                      "Points below the ceiling; path orange, keyframes blue, loops red.");
    }

    std::string grid() const {
        return figure(embeddedImage("image/png", run_.grid_png, "occupancy grid"),
                      "Obstacles black, free white, unseen grey.", "grid-picture");
    }

    std::string path() const {
        const auto lost = lostSpans(run_.frames);
        std::vector<ChartLine> lines;
        const auto add = [&](const char* name, const char* css_class, const Trajectory& poses) {
            ChartLine line{name, css_class, {}};
            std::vector<double> seconds;
            for (const StampedPose& pose : thinned(poses)) {
                line.points.push_back(pose.T_world_cam.t.head<2>());
                seconds.push_back(pose.stamp_s - run_.start_s);
            }
            const auto pieces = withoutGaps(line, seconds, lost);
            lines.insert(lines.end(), pieces.begin(), pieces.end());
        };
        add("truth", "truth", run_.truth);
        add("estimate", "estimate", run_.trajectory);
        return planChart(lines);
    }

    std::string loops() const {
        if (run_.loops.empty()) return {};
        std::vector<ChartLine> lines{
            pathOf("keyframes by tracking alone", "before", run_.keyframes_before_loops),
            pathOf("keyframes with loops", "after", run_.keyframes)};
        for (const LoopRecord& loop : run_.loops) {
            const auto at = [&](int i) -> Eigen::Vector2d {
                return run_.keyframes[static_cast<std::size_t>(i)].T_world_cam.t.head<2>();
            };
            const bool first = &loop == &run_.loops.front();
            lines.push_back({first ? "loop" : "", "loop", {at(loop.from), at(loop.to)}});
        }
        return planChart(lines);
    }

    std::string errors() const {
        if (!ate_) return {};
        ChartLine line{"", "value", {}};
        std::vector<double> seconds;
        for (const AtePair& pair : ate_->pairs) {
            seconds.push_back(pair.stamp_s - run_.start_s);
            line.points.emplace_back(seconds.back(), 1e3 * pair.error_m().norm());
        }
        return timeChart(withoutGaps(line, seconds, lostSpans(run_.frames)),
                         "distance to the true place, mm");
    }

    std::string landmarks() const {
        ChartLine line{"", "value", {}};
        for (const FrameRecord& frame : run_.frames) {
            line.points.emplace_back(frame.seconds, frame.inliers);
        }
        std::vector<std::pair<double, double>> lost;
        for (const LostSpan& span : lostSpans(run_.frames)) {
            lost.emplace_back(span.first_s, span.last_s);
        }
        return timeChart({line},
                         lost.empty() ? "landmarks a frame" : "landmarks a frame; lost: red", lost);
    }

    /** Bars tell the stage's share of all CPU time. */
    std::string stages() const {
        double all_ms = 1e-9;
        for (const StageRecord& stage : run_.stages) all_ms += totalMs(stage);
        std::string html =
            "<table><tr><th>stage</th><th>calls</th><th>mean</th><th>median</th><th>95 %</th>"
            "<th>max</th><th></th></tr>\n";
        for (const StageRecord& stage : run_.stages) {
            html += "<tr><td>" + htmlEscaped(stage.name) + "</td>" +
                    formatted(
                        "<td>%zu</td><td>%.2f</td><td>%.2f</td><td>%.2f</td><td>%.1f</td>"
                        "<td class=\"bar\"><i style=\"width:%.1f%%\"></i></td></tr>\n",
                        stage.calls, stage.mean_ms, stage.median_ms, stage.p95_ms, stage.max_ms,
                        100 * totalMs(stage) / all_ms);
        }
        return html + "</table>" +
               figure(" ",
                      formatted("CPU ms a call; bars are shares of the whole. Dense maps: %.1f s.",
                                run_.maps_wall_s));
    }

    static double totalMs(const StageRecord& stage) {
        return stage.mean_ms * static_cast<double>(stage.calls);
    }

    std::string keyframes() const {
        return figure(embeddedImage("image/jpeg", run_.keyframes_jpg, "keyframes"),
                      "Some keyframes: number and time since the first frame.");
    }

    const RunRecord& run_;
    std::optional<AteResult> ate_;
};

}  // namespace

std::string runReportHtml(const RunRecord& run) {
    return Page(run).html();
}

void writeRunReport(const std::string& run_folder, const std::string& map_folder) {
    const RunRecord run = readRunRecord(run_folder, map_folder);
    writeTextAtomically(map_folder + "/report.html", runReportHtml(run));
}

}  // namespace rgbd_graphslam
