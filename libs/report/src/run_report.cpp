#include "rgbd_graphslam/report/run_report.h"

#include <algorithm>
#include <filesystem>

#include "motion_section.h"
#include "page_template.h"
#include "quality_section.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/report/html.h"
#include "rgbd_graphslam/report/run_findings.h"
#include "rgbd_graphslam/report/svg_chart.h"
#include "run_charts.h"
#include "run_tables.h"

namespace rgbd_graphslam {
namespace {

/** Nothing without content.
 *  \param title plain text
 *  \param content HTML */
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

/** \param text plain */
std::string note(const std::string& text) {
    return "<p class=\"note\">" + htmlEscaped(text) + "</p>\n";
}

std::optional<AteResult> ateOf(const RunRecord& run) {
    if (run.truth.empty()) return std::nullopt;
    try {
        return evaluateAte(run.trajectory, run.truth);
    } catch (const Error&) {
        return std::nullopt;  // too few poses match to compare
    }
}

/** One of an earlier run in the folder goes where there is none now. */
void writeLoopPicture(const RunRecord& run, const std::string& path) {
    const std::string chart = loopChart(run);
    if (chart.empty()) {
        std::filesystem::remove(path);
    } else {
        writeTextAtomically(path, svgFile(chart));
    }
}

class Page {
  public:
    explicit Page(const RunRecord& run) : run_(run), ate_(ateOf(run)) {}

    std::string html() const {
        const std::string name = std::filesystem::path(run_.rawlog).filename().string();
        return filled(report_page, {{"title", htmlEscaped(name)},
                                    {"chart_style", chart_style},
                                    {"subtitle", subtitle()},
                                    {"figures", figures()},
                                    {"findings", findings()},
                                    {"sections", sections()}});
    }

  private:
    std::string subtitle() const {
        std::string text = "SLAM by rgbd-slam " + htmlEscaped(run_.version);
        if (!run_.origin.date.empty()) text += ", " + htmlEscaped(run_.origin.date);
        return text;
    }

    std::string figures() const {
        std::string html;
        const auto add = [&](const std::string& value, const char* what) {
            html += "<div><b>" + value + "</b><span>" + what + "</span></div>\n";
        };
        const std::size_t located = run_.frames.size() - run_.count(FrameState::Lost);
        add(std::to_string(located) + " / " + std::to_string(run_.frames.size()),
            "frames with pose");
        if (!run_.frames.empty()) add(formatted("%.1f s", run_.frames.back().seconds), "duration");
        add(formatted("%.2f m", run_.path_m), "path length");
        add(std::to_string(run_.keyframes.size()), "keyframes");
        add(std::to_string(run_.loops.size()), "loops");
        add(std::to_string(run_.landmarks), "landmarks");
        if (run_.ate_rmse_m) add(figureText(1e3 * *run_.ate_rmse_m) + " mm", "ATE RMSE");
        add(formatted("%.0f", run_.frames_per_s), "frames/s");
        add(figureText(run_.cpu_ms_a_frame) + " ms", "CPU per frame");
        add(formatted("%.0f MB", run_.peak_memory_mb), "peak memory");
        return html;
    }

    std::string findings() const {
        const auto found = findingsOf(run_, ate_);
        const bool warned = std::any_of(found.begin(), found.end(), [](const Finding& finding) {
            return finding.kind == Finding::Kind::Warning;
        });
        std::string html;
        if (!warned) html += "<li class=\"good\">all frames were tracked; no warnings</li>\n";
        for (const Finding& finding : found) {
            html += finding.kind == Finding::Kind::Warning ? "<li class=\"warning\">" : "<li>";
            html += htmlEscaped(finding.text) + "</li>\n";
        }
        return html;
    }

    std::string sections() const {
        return section("3-D map", perspective(), "wide") + section("Map from above", mapPicture()) +
               section("Obstacles and free space", grid()) +
               section("Trajectory from above", pathChart(run_)) +
               section("Loop closure", loops()) +
               section("Quality without ground truth", qualitySection(run_)) +
               section("Sensors", sensors(), "wide") +
               section("IMU and wheels", motionSection(run_)) +
               section("Error over time", ate_ ? errorChart(run_, *ate_) : std::string()) +
               section("Inliers", landmarkChart(run_)) +
               section("CPU time by stage", stages(), "wide") +
               section("Keyframes", keyframes(), "wide") +
               section("About this run", aboutTable(run_), "wide");
    }

    std::string perspective() const {
        return figure(embeddedImage("image/jpeg", run_.map3d_jpg, "map in perspective"),
                      "Points below the ceiling; trajectory orange, keyframes blue, loops red. "
                      "The scale bar holds for the middle of the map.");
    }

    std::string mapPicture() const {
        return figure(embeddedImage("image/png", run_.map_png, "map from above"),
                      "Points below the ceiling; trajectory orange, keyframes blue, loops red.",
                      "plan");
    }

    std::string grid() const {
        return figure(embeddedImage("image/png", run_.grid_png, "occupancy grid"),
                      "Obstacles black, free white, unseen gray.", "grid-picture");
    }

    std::string loops() const {
        if (run_.loops.empty()) return {};
        return loopChart(run_) + note(loopSummary(run_)) + loopTable(run_);
    }

    std::string sensors() const {
        const std::string table = sensorTable(run_);
        if (table.empty()) return {};
        return table + note("Residuals are root mean squares; over sigma 1 is expected.");
    }

    std::string stages() const {
        if (run_.stages.empty()) return {};
        return stageTable(run_) +
               note(formatted("CPU time per call in ms, and share of the total. Dense maps took "
                              "another %.1f s.",
                              run_.maps_wall_s));
    }

    std::string keyframes() const {
        return figure(
            embeddedImage("image/jpeg", run_.keyframes_jpg, "keyframes"),
            "A selection of keyframes, with their numbers and the time since the first frame.");
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
    writeLoopPicture(run, map_folder + "/loops.svg");
    writeTextAtomically(map_folder + "/report.html", runReportHtml(run));
}

}  // namespace rgbd_graphslam
