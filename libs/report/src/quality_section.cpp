#include "quality_section.h"

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/report/html.h"

namespace rgbd_graphslam {
namespace {

std::string row(const char* what, const std::string& value, const char* meaning) {
    return std::string("<tr><td>") + what + "</td><td>" + htmlEscaped(value) + "</td><td>" +
           htmlEscaped(meaning) + "</td></tr>\n";
}

std::string framesRow(const RunRecord& run) {
    if (run.frames.empty()) return {};
    const auto percent = [&](FrameState state) {
        return 100. * static_cast<double>(run.count(state)) /
               static_cast<double>(run.frames.size());
    };
    return row(
        "frames",
        formatted("%.1f %% tracked, %.1f %% recovered, %.1f %% uncertain, %.1f %% dead-reckoned, "
                  "%.1f %% lost",
                  percent(FrameState::Tracked), percent(FrameState::Recovered),
                  percent(FrameState::Uncertain), percent(FrameState::DeadReckoned),
                  percent(FrameState::Lost)),
        "by landmarks; relocalized after a loss; by too few landmarks to build on; by motion "
        "only; not at all");
}

std::string driftRow(const QualityRecord& quality) {
    if (!quality.drift_gap_m || !quality.drift_path_m) return {};
    const double percent =
        *quality.drift_path_m > 0 ? 100 * *quality.drift_gap_m / *quality.drift_path_m : 0;
    return row("drift before loops",
               formatted("%.3f m (%.2f %% of %.1f m)", *quality.drift_gap_m, percent,
                         *quality.drift_path_m),
               "largest gap that a loop closed");
}

std::string rows(const RunRecord& run) {
    const QualityRecord& q = run.quality;
    std::string html;
    if (q.spread_median_mm && q.spread_p95_mm) {
        html +=
            row("surfaces",
                formatted("%.1f mm, 95 %% within %.1f mm", *q.spread_median_mm, *q.spread_p95_mm),
                "distance between what two or more keyframes see of one surface");
    }
    if (q.loop_median_mm && q.loop_max_mm && q.loop_median_deg && q.loop_max_deg) {
        html += row("loop residuals",
                    formatted("%.1f mm and %.2f°, at most %.1f mm and %.2f°", *q.loop_median_mm,
                              *q.loop_median_deg, *q.loop_max_mm, *q.loop_max_deg),
                    "final map against what each loop measured");
    }
    html += driftRow(q) + framesRow(run);
    if (q.inliers_median && q.inliers_p05) {
        html += row(
            "inliers",
            formatted("%.0f, in 95 %% of the frames above %.0f", *q.inliers_median, *q.inliers_p05),
            "landmarks that agree with a frame's pose");
    }
    if (q.depth_median && q.depth_p05) {
        html += row("pixels with depth",
                    formatted("%.0f %%, in 95 %% of the keyframes above %.0f %%",
                              100 * *q.depth_median, 100 * *q.depth_p05),
                    "in the range that is used");
    }
    return html;
}

}  // namespace

std::string qualitySection(const RunRecord& run) {
    if (!run.quality.inliers_median) return {};
    return "<table class=\"quality\"><tr><th>figure</th><th>median</th><th>meaning</th></tr>\n" +
           rows(run) +
           "</table><p class=\"note\">Surfaces that lie apart and loops that do not fit tell of "
           "drift, a wrong calibration, noise or things that moved. A depth scale that is wrong "
           "everywhere alike cannot be seen without ground truth or another sensor.</p>\n";
}

}  // namespace rgbd_graphslam
