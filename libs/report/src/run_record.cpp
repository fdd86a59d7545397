#include "rgbd_graphslam/report/run_record.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "motion_section.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

/** Empty when there is no such file. */
std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

FrameState stateOf(const std::string& word, const std::string& place) {
    if (word == "tracked") return FrameState::Tracked;
    if (word == "recovered") return FrameState::Recovered;
    // "weak" is what the first edition wrote.
    if (word == "dead_reckoned" || word == "weak") return FrameState::DeadReckoned;
    if (word == "uncertain") return FrameState::Uncertain;
    if (word == "lost") return FrameState::Lost;
    throw Error(place + ": a frame is tracked, recovered, dead_reckoned, uncertain or lost",
                "run rgbd-slam again");
}

/** Lines of stamp_s,origin,inliers,keyframe,submap below a line of titles. */
void readFrames(const fs::path& path, RunRecord& run) {
    std::ifstream in(path);
    if (!in) throw Error("cannot read '" + path.string() + "'", "run rgbd-slam again");
    std::string line;
    std::getline(in, line);
    for (int number = 2; std::getline(in, line); ++number) {
        const std::string place = path.string() + ":" + std::to_string(number);
        std::istringstream fields(line);
        std::string state, keyframe;
        double stamp_s = 0;
        char comma = 0;
        ReportedFrame frame;
        if (!(fields >> stamp_s >> comma) || !std::getline(fields, state, ',') ||
            !(fields >> frame.inliers >> comma)) {
            throw Error(place + " is no line of stamp, state, inliers, keyframe",
                        "run rgbd-slam again");
        }
        if (run.frames.empty()) run.start_s = stamp_s;
        frame.seconds = stamp_s - run.start_s;
        frame.state = stateOf(state, place);
        std::getline(fields, keyframe, ',');
        frame.keyframe = !keyframe.empty();
        run.frames.push_back(frame);
    }
}

std::string textOf(const Json& summary, const char* key) {
    const Json& value = summary.at(key);
    return value.is_null() ? std::string() : value.get<std::string>();
}

std::vector<StageRecord> stagesOf(const Json& stages) {
    std::vector<StageRecord> records;
    for (const auto& [name, stage] : stages.items()) {
        const Json& cpu = stage.at("cpu_ms");
        records.push_back({name, stage.at("calls"), cpu.at("mean"), cpu.at("median"), cpu.at("p95"),
                           cpu.at("max")});
    }
    const auto total = [](const StageRecord& stage) {
        return stage.mean_ms * static_cast<double>(stage.calls);
    };
    std::stable_sort(records.begin(), records.end(),
                     [&](const auto& a, const auto& b) { return total(a) > total(b); });
    return records;
}

/** Runs of earlier versions have none. */
std::optional<double> loopErrorOf(const Json& edge) {
    if (edge.size() < 4 || edge.at(3).is_null()) return std::nullopt;
    return edge.at(3).get<double>();
}

RunOrigin originOf(const Json& summary) {
    const Json json = summary.value("origin", Json::object());
    RunOrigin origin{json.value("command", ""), json.value("date", ""), {}};
    const Json camera = json.value("camera", Json());
    if (camera.is_null()) return origin;
    const std::string lens = camera.value("lens", "plumb_bob");  // earlier runs had no other
    origin.camera = Intrinsics{camera.at("width"),
                               camera.at("height"),
                               camera.at("fx"),
                               camera.at("fy"),
                               camera.at("cx"),
                               camera.at("cy"),
                               makeLens(lens, camera.at("distortion"))};
    return origin;
}

/** \param path of names from the object inwards */
std::optional<double> numberAt(const Json& object, std::initializer_list<const char*> path) {
    const Json* value = &object;
    for (const char* name : path) {
        if (!value->is_object() || !value->contains(name)) return std::nullopt;
        value = &value->at(name);
    }
    if (!value->is_number()) return std::nullopt;
    return value->get<double>();
}

QualityRecord qualityOf(const Json& quality) {
    QualityRecord record;
    record.inliers_median = numberAt(quality, {"inliers", "median"});
    record.inliers_p05 = numberAt(quality, {"inliers", "p05"});
    record.depth_median = numberAt(quality, {"depth_coverage", "median"});
    record.depth_p05 = numberAt(quality, {"depth_coverage", "p05"});
    record.spread_median_mm = numberAt(quality, {"surface_spread", "median_mm"});
    record.spread_p95_mm = numberAt(quality, {"surface_spread", "p95_mm"});
    record.loop_median_mm = numberAt(quality, {"loop_residuals", "median_mm"});
    record.loop_max_mm = numberAt(quality, {"loop_residuals", "max_mm"});
    record.loop_median_deg = numberAt(quality, {"loop_residuals", "median_deg"});
    record.loop_max_deg = numberAt(quality, {"loop_residuals", "max_deg"});
    record.drift_gap_m = numberAt(quality, {"drift_before_loops", "gap_m"});
    record.drift_path_m = numberAt(quality, {"drift_before_loops", "path_m"});
    return record;
}

/** Runs of earlier versions have none. */
std::vector<SensorUse> sensorsOf(const Json& figures) {
    std::vector<SensorUse> sensors;
    for (const Json& sensor : figures) {
        sensors.push_back({sensor.at("label"), sensor.at("class"), sensor.at("use"),
                           sensor.at("readings"), sensor.at("used"), sensor.at("rate_hz"),
                           sensor.at("longest_gap_s"), numberAt(sensor, {"residual_m"}),
                           numberAt(sensor, {"whitened_residual"})});
    }
    return sensors;
}

void readFigures(const Json& summary, RunRecord& run) {
    run.origin = originOf(summary);
    run.rawlog = textOf(summary, "rawlog");
    run.version = textOf(summary, "version");
    run.config_hash = textOf(summary, "config_hash");
    run.interrupted = summary.at("interrupted");
    run.damage = textOf(summary, "damage");
    run.warnings = summary.value("warnings", std::vector<std::string>());
    run.out_of_order = summary.at("out_of_order");
    run.landmarks = summary.at("landmarks");
    run.culled_keyframes = summary.at("culled_keyframes");
    run.path_m = summary.at("path_m");
    run.frames_per_s = summary.at("frames_per_s");
    run.cpu_ms_a_frame = summary.at("cpu_ms_a_frame");
    run.maps_wall_s = summary.at("maps_wall_s");
    run.peak_memory_mb = summary.at("peak_memory_mb");
    run.stages = stagesOf(summary.at("stages"));
    for (const Json& session : summary.value("earlier_sessions", Json::array())) {
        run.earlier_keyframes.push_back(session.at("keyframes"));
    }
    for (const Json& edge : summary.at("loop_edges")) {
        run.loops.push_back({edge.at(0), edge.at(1), edge.at(2), loopErrorOf(edge)});
    }
    run.sensors = sensorsOf(summary.value("sensor_figures", Json::array()));
    run.quality = qualityOf(summary.value("quality", Json()));
    run.motion = motionFigures(summary.value("motion", Json()));
    const Json ate = summary.value("ate", Json());
    if (!ate.is_null()) run.ate_rmse_m = ate.at("rmse_m").get<double>();
    const Json false_loops = summary.value("false_loops", Json());
    if (!false_loops.is_null()) run.false_loops = false_loops.get<std::size_t>();
}

void readSummary(const fs::path& path, RunRecord& run) {
    try {
        readFigures(Json::parse(bytesOf(path)), run);
    } catch (const Json::exception&) {
        throw Error("'" + path.string() + "' is missing or not as rgbd-slam writes it",
                    "run rgbd-slam again");
    }
}

void checkLoops(const RunRecord& run, const std::string& folder) {
    const int keyframes = static_cast<int>(run.keyframes.size());
    for (const LoopRecord& loop : run.loops) {
        if (std::min(loop.from, loop.to) >= 0 && std::max(loop.from, loop.to) < keyframes) continue;
        throw Error("summary.json in '" + folder + "' names a loop beyond keyframes.txt",
                    "run rgbd-slam again");
    }
}

Trajectory readIfThere(const fs::path& path) {
    return fs::exists(path) ? readTumPoses(path.string()) : Trajectory();
}

}  // namespace

std::size_t RunRecord::count(FrameState state) const {
    return static_cast<std::size_t>(std::count_if(
        frames.begin(), frames.end(), [&](const ReportedFrame& f) { return f.state == state; }));
}

RunRecord readRunRecord(const std::string& run_folder, const std::string& map_folder) {
    const fs::path run_path(run_folder), map_path(map_folder);
    RunRecord run;
    readSummary(run_path / "summary.json", run);
    readFrames(run_path / "frames.csv", run);
    run.trajectory = readTumTrajectory((run_path / "trajectory.txt").string());
    run.keyframes = readTumPoses((run_path / "keyframes.txt").string());
    run.keyframes_before_loops = readIfThere(run_path / "keyframes_before_loops.txt");
    run.truth = readIfThere(run_path / "truth.txt");
    run.keyframes_jpg = bytesOf(run_path / "keyframes.jpg");
    run.map3d_jpg = bytesOf(map_path / "map3d.jpg");
    run.map_png = bytesOf(map_path / "map.png");
    run.grid_png = bytesOf(map_path / "grid.png");
    checkLoops(run, run_folder);
    return run;
}

}  // namespace rgbd_graphslam
