#include "output_texts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "motion_json.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/printable_text.h"
#include "rgbd_graphslam/metrics/statistics.h"
#include "run_origin.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const StageFigures& figures) {
    return {{"mean", figures.mean},
            {"median", figures.median},
            {"p95", figures.p95},
            {"max", figures.max}};
}

Json stagesJson(const JobReport& report) {
    Json stages;
    for (const auto& stage : report.stages) {
        stages[stage.stage] = {{"calls", stage.wall_ms.size()},
                               {"cpu_ms", toJson(figuresOf(stage.cpu_ms))},
                               {"wall_ms", toJson(figuresOf(stage.wall_ms))}};
    }
    return stages;
}

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json ateJson(const JobReport& report) {
    if (!report.ate_rmse_m) return nullptr;
    return {{"rmse_m", *report.ate_rmse_m},
            {"pairs", report.ate_pairs},
            {"fitted_scale", orNull(report.ate_fitted_scale)}};
}

/** In order of the total time they took. */
std::vector<VisualSlam::StageTime> byCost(std::vector<VisualSlam::StageTime> stages) {
    const auto total = [](const auto& stage) {
        return std::accumulate(stage.cpu_ms.begin(), stage.cpu_ms.end(), 0.0);
    };
    std::stable_sort(stages.begin(), stages.end(),
                     [&](const auto& a, const auto& b) { return total(a) > total(b); });
    return stages;
}

Json loopEdgesJson(const JobReport& report) {
    Json edges = Json::array();
    for (const ReportedLoop& loop : report.loops) {
        edges.push_back({loop.from, loop.to, loop.inliers, orNull(loop.error_m)});
    }
    return edges;
}

Json mapJson(const SlamJob& job) {
    if (job.map_folder.empty()) return nullptr;
    return {{"folder", std::filesystem::absolute(job.map_folder).lexically_normal().string()},
            {"use", job.localizes() ? "localize" : "extend"}};
}

/** Of a camera; null = that of the first frame. */
Json labelJson(const std::string& label) {
    return label.empty() ? Json(nullptr) : Json(label);
}

Json earlierJson(const JobReport& report) {
    Json sessions = Json::array();
    for (const EarlierSession& session : report.earlier) {
        sessions.push_back({{"rawlog", session.rawlog},
                            {"sensor", labelJson(session.sensor_label)},
                            {"keyframes", session.keyframes}});
    }
    return sessions;
}

Json spreadJson(const RunQuality& quality) {
    if (!quality.spread) return nullptr;
    return {{"surfaces", quality.spread->surfaces},
            {"median_mm", 1e3 * quality.spread->median_m},
            {"p95_mm", 1e3 * quality.spread->p95_m}};
}

Json loopResidualsJson(const RunQuality& quality) {
    if (!quality.loops) return nullptr;
    return {{"median_mm", 1e3 * quality.loops->median_m},
            {"max_mm", 1e3 * quality.loops->max_m},
            {"median_deg", quality.loops->median_deg},
            {"max_deg", quality.loops->max_deg}};
}

Json driftJson(const RunQuality& quality) {
    if (!quality.drift) return nullptr;
    return {{"gap_m", quality.drift->gap_m},
            {"path_m", quality.drift->path_m},
            {"percent", 100 * quality.drift->share()}};
}

Json readoutJson(const RunQuality& quality) {
    if (!quality.readout) return nullptr;
    return {{"readout_ms", 1e3 * quality.readout->seconds},
            {"sigma_ms", 1e3 * quality.readout->sigma_s},
            {"detected", isRollingShutter(*quality.readout)}};
}

Json qualityJson(const RunQuality& quality) {
    return {{"frames",
             {{"tracked", quality.tracked},
              {"recovered", quality.recovered},
              {"dead_reckoned", quality.dead_reckoned},
              {"lost", quality.lost}}},
            {"inliers", {{"median", quality.inliers_median}, {"p05", quality.inliers_p05}}},
            {"depth_coverage", quality.depth_median ? Json{{"median", *quality.depth_median},
                                                           {"p05", orNull(quality.depth_p05)}}
                                                    : Json(nullptr)},
            {"surface_spread", spreadJson(quality)},
            {"loop_residuals", loopResidualsJson(quality)},
            {"drift_before_loops", driftJson(quality)},
            {"rolling_shutter", readoutJson(quality)}};
}

Json sensorsJson(const JobReport& report) {
    Json sensors = Json::array();
    for (const SensorRecord& sensor : report.sensors) {
        sensors.push_back({{"label", sensor.label},
                           {"class", sensor.class_name},
                           {"count", sensor.count},
                           {"used", sensor.used}});
    }
    return sensors;
}

Json sensorFiguresJson(const JobReport& report) {
    Json sensors = Json::array();
    for (const SensorFigures& sensor : report.sensor_figures) {
        sensors.push_back({{"label", sensor.label},
                           {"class", sensor.class_name},
                           {"readings", sensor.readings},
                           {"used", sensor.used},
                           {"rate_hz", sensor.rate_hz},
                           {"longest_gap_s", sensor.longest_gap_s},
                           {"residual_m", orNull(sensor.residual_m)},
                           {"whitened_residual", orNull(sensor.whitened)},
                           {"use", sensor.use}});
    }
    return sensors;
}

Json liveSensorsJson(const LiveStatistics& live) {
    Json sensors = Json::array();
    for (const LiveSensorStatistics& sensor : live.sensors) {
        sensors.push_back({{"label", sensor.label},
                           {"class", sensor.class_name},
                           {"received", sensor.received},
                           {"dropped", sensor.dropped},
                           {"late", sensor.late},
                           {"silences", sensor.silences},
                           {"longest_silence_s", sensor.longest_silence_s},
                           {"clock_jumps", sensor.clock_jumps}});
    }
    return sensors;
}

Json latencyJson(const std::vector<double>& ms) {
    if (ms.empty()) return nullptr;
    return {{"frames", ms.size()},
            {"p50", percentileOf(ms, 0.5)},
            {"p99", percentileOf(ms, 0.99)},
            {"max", statisticsOf(ms).max}};
}

Json liveJson(const JobReport& report) {
    if (!report.live) return nullptr;
    const LiveStatistics& live = *report.live;
    return {{"latency_ms", latencyJson(live.latencies_ms)},
            {"completion_ms", latencyJson(live.completions_ms)},
            {"starting_frames", live.starting_frames},
            {"dropped", live.dropped()},
            {"late", live.late()},
            {"failures", live.failures},
            {"sensors", liveSensorsJson(live)}};
}

std::string liveLines(const LiveStatistics& live) {
    std::string text =
        formatted("live          %zu frames dropped, %zu measurements late, %zu failures\n",
                  live.dropped(), live.late(), live.failures);
    const std::vector<double>& ms = live.latencies_ms;
    if (ms.empty()) return text;
    return text + formatted("latency       p50 %.1f ms, p99 %.1f ms, max %.1f ms, image to pose\n",
                            percentileOf(ms, 0.5), percentileOf(ms, 0.99), statisticsOf(ms).max);
}

}  // namespace

StageFigures figuresOf(const std::vector<double>& ms) {
    const Statistics statistics = statisticsOf(ms);
    return {statistics.mean, statistics.median, percentileOf(ms, 0.95), statistics.max};
}

std::string framesCsv(const std::vector<TrackedFrame>& frames) {
    std::string text =
        "stamp_s,origin,inliers,keyframe,submap,std_x_m,std_y_m,std_z_m,std_rot_x_rad,"
        "std_rot_y_rad,std_rot_z_rad\n";
    for (const TrackedFrame& frame : frames) {
        text += formatted("%.6f,%s,%d,", frame.stamp_s, toString(frame.origin), frame.inliers);
        text += (frame.keyframe ? std::to_string(*frame.keyframe) : "") + ",";
        text += (frame.origin == FrameOrigin::Lost ? "" : std::to_string(frame.submap));
        for (int i = 0; i < 6; ++i) {
            text +=
                frame.covariance ? formatted(",%.5f", std::sqrt((*frame.covariance)(i, i))) : ",";
        }
        text += "\n";
    }
    return text;
}

std::string frameTimesCsv(const std::vector<FrameTime>& times) {
    std::string text = "stamp_s,wall_ms\n";
    for (const FrameTime& time : times)
        text += formatted("%.6f,%.3f\n", time.stamp_s, time.wall_ms);
    return text;
}

std::string covisibilityCsv(const std::vector<PoseEdge>& edges) {
    std::string text = "from,to,landmarks\n";
    for (const PoseEdge& edge : edges) {
        text += formatted("%d,%d,%d\n", edge.from, edge.to, edge.inliers);
    }
    return text;
}

std::string summaryJson(const SlamJob& job, const JobReport& report) {
    const Json summary = {
        {"version", RGBD_VERSION},
        {"config_hash", configHash(job.options)},
        {"origin", originJson(report.camera)},
        {"rawlog", std::filesystem::absolute(job.rawlog).lexically_normal().string()},
        {"sensor", labelJson(job.sensor_label)},
        {"sensors", sensorsJson(report)},
        {"sensor_figures", sensorFiguresJson(report)},
        {"map", mapJson(job)},
        {"earlier_sessions", earlierJson(report)},
        {"interrupted", report.interrupted},
        {"damage", report.damage.empty() ? Json(nullptr) : Json(report.damage)},
        {"limit", report.limit.empty() ? Json(nullptr) : Json(report.limit)},
        {"warnings", report.warnings},
        {"frames", report.frames},
        {"tracked", report.tracked},
        {"recovered", report.recovered},
        {"dead_reckoned", report.dead_reckoned},
        {"uncertain", report.uncertain},
        {"lost", report.lost},
        {"disconnected", report.disconnected},
        {"out_of_order", report.out_of_order},
        {"keyframes", report.keyframes},
        {"disconnected_keyframes", report.disconnected_keyframes},
        {"culled_keyframes", report.culled_keyframes},
        {"landmarks", report.landmarks},
        {"loops", report.loops.size()},
        {"false_loops", orNull(report.false_loops)},
        {"loop_edges", loopEdgesJson(report)},
        {"path_m", report.path_m},
        {"ate", ateJson(report)},
        {"quality", qualityJson(report.quality)},
        {"motion", motionJson(report.motion, report.imu_delay)},
        {"live", liveJson(report)},
        {"frames_per_s", report.framesPerSecond()},
        {"cpu_ms_a_frame", report.cpuMsAFrame()},
        {"tracking_wall_s", report.tracking_wall_s},
        {"maps_wall_s", report.maps_wall_s},
        {"peak_memory_mb", report.peak_memory_mb},
        {"stages", stagesJson(report)}};
    // Names of files may be no UTF-8, which JSON cannot hold.
    return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

std::string sensorsLine(const std::vector<SensorRecord>& sensors) {
    const bool all_used =
        std::all_of(sensors.begin(), sensors.end(), [](const auto& s) { return s.used; });
    return sensorsText(sensors, true) +
           (all_used ? std::string() : "; not used: " + sensorsText(sensors, false));
}

}  // namespace

std::string resultTable(const SlamJob& job, const JobReport& report) {
    std::string text = formatted(
        "frames        %zu: %zu tracked, %zu recovered, %zu dead-reckoned, %zu lost\n",
        report.frames, report.tracked, report.recovered, report.dead_reckoned, report.lost);
    if (report.uncertain > 0) {
        text += formatted("uncertain     %zu frames\n", report.uncertain);
    }
    if (report.disconnected > 0)
        text += formatted("disconnected  %zu of them\n", report.disconnected);
    if (report.out_of_order > 0) {
        text += formatted("left out      %zu frames out of order\n", report.out_of_order);
    }
    text += "sensors       " + printableLine(sensorsLine(report.sensors)) + "\n";
    text += formatted("keyframes     %zu\nloops         %zu\npath          %.2f m\n",
                      report.keyframes, report.loops.size(), report.path_m);
    if (report.ate_rmse_m) {
        text += formatted("ATE RMSE      %.4f m over %zu poses\n", *report.ate_rmse_m,
                          report.ate_pairs);
    }
    text += "quality       " + qualityText(report.quality) + "\n";
    text += formatted("speed         %.1f frames/s, %.1f ms CPU per frame\n",
                      report.framesPerSecond(), report.cpuMsAFrame());
    if (report.live) text += liveLines(*report.live);
    text += formatted("peak memory   %.0f MB\n", report.peak_memory_mb);
    return text + "written to    " + job.out_folder + "\n";
}

std::string profileTable(const JobReport& report) {
    std::string text =
        formatted("%-18s %7s | %27s | %27s\n%-18s %7s | %s | %s\n", "", "", "CPU ms", "wall ms",
                  "stage", "calls", "  mean    p50    p95    max", "  mean    p50    p95    max");
    for (const auto& stage : byCost(report.stages)) {
        const StageFigures cpu = figuresOf(stage.cpu_ms), wall = figuresOf(stage.wall_ms);
        text += formatted("%-18s %7zu | %6.2f %6.2f %6.2f %6.1f | %6.2f %6.2f %6.2f %6.1f\n",
                          stage.stage.c_str(), stage.wall_ms.size(), cpu.mean, cpu.median, cpu.p95,
                          cpu.max, wall.mean, wall.median, wall.p95, wall.max);
    }
    return text;
}

}  // namespace rgbd_graphslam
