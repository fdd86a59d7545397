#include "run_output.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "output_texts.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/mapping/map_builder.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "rgbd_graphslam/metrics/statistics.h"
#include "rgbd_graphslam/report/run_report.h"
#include "rgbd_graphslam/semantics/semantic_maps.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr const char* before_loops_name = "keyframes_before_loops.txt";
constexpr const char* truth_name = "truth.txt";

/** Keyframes chained by the relative poses that tracking measured between them, before any loop. */
Trajectory chained(Trajectory keyframes, const std::vector<SE3>& T_previous_keyframe) {
    for (std::size_t k = 1; k < keyframes.size(); ++k) {
        keyframes[k].T_world_cam = keyframes[k - 1].T_world_cam * T_previous_keyframe[k];
    }
    return keyframes;
}

MapInputs mapInputs(const RunState& run) {
    MapInputs inputs;
    inputs.rawlog = run.job.rawlog;
    inputs.sensor_label = run.job.sensor_label;
    inputs.entries = run.entries;
    inputs.moving_classes = run.job.options.semantics.moving_classes;
    inputs.earlier = run.report.earlier;
    inputs.trajectory = run.located();
    inputs.unplaced_s = run.unplaced();
    inputs.disconnected = run.report.disconnected_keyframes;
    for (const KeyframeView& keyframe : run.session.slam().keyframes()) {
        inputs.keyframes.push_back({keyframe.stamp_s, keyframe.T_world_cam});
    }
    for (const ReportedLoop& loop : run.report.loops) {
        inputs.loops.push_back({loop.from, loop.to, loop.inliers});
    }
    if (!inputs.loops.empty()) {
        inputs.keyframes_before_loops = chained(inputs.keyframes, run.T_previous_keyframe);
    }
    return inputs;
}

std::string pathOf(const RunState& run, const std::string& name) {
    return run.job.out_folder + "/" + name;
}

/** In order of the sessions. */
std::vector<FrameEntries> entriesOf(const MapInputs& inputs) {
    std::vector<FrameEntries> sessions;
    for (const EarlierSession& session : inputs.earlier) sessions.push_back(session.entries);
    sessions.push_back(inputs.entries);
    return sessions;
}

void writePoses(const RunState& run, const std::string& name, const Trajectory& poses) {
    writeTextAtomically(pathOf(run, name), toTumText(poses));
}

Trajectory moved(Trajectory trajectory, const SE3& T_up_world) {
    for (StampedPose& pose : trajectory) pose.T_world_cam = T_up_world * pose.T_world_cam;
    return trajectory;
}

void writeAllPoses(const RunState& run, const MapInputs& upright, const SE3& T_up_world) {
    writePoses(run, "trajectory.txt", upright.trajectory);
    writePoses(run, "keyframes.txt", upright.keyframes);
    if (!upright.keyframes_before_loops.empty()) {
        writePoses(run, before_loops_name, upright.keyframes_before_loops);
    }
    if (!run.truth.empty()) writePoses(run, truth_name, moved(run.truth, T_up_world));
    run.session.writeGraph(pathOf(run, "graph.graph"), T_up_world);
}

/** Poses that not every run has: those of an earlier run into this folder would be taken for this
 *  one's. */
void removePosesOfEarlierRun(const RunState& run) {
    std::error_code ignored;
    if (run.report.loops.empty()) fs::remove(pathOf(run, before_loops_name), ignored);
    if (run.truth.empty()) fs::remove(pathOf(run, truth_name), ignored);
}

/** \throws Error saying why no frame became a keyframe */
[[noreturn]] void refuseEmptyMap(const RunState& run) {
    if (!run.report.damage.empty()) throw Error(run.report.damage);
    throw Error("none of the " + std::to_string(run.report.frames) + " frames of '" +
                    run.job.rawlog + "' could start a map",
                "check depth scale and calibration, and that the camera sees texture");
}

/** What the keyframes' images and their places in the finished map say of its quality. */
void describeMapQuality(const MapInputs& inputs, const MapSnapshot& map, RunState& run) {
    RunQuality& quality = run.report.quality;
    quality.drift = driftBeforeLoops(map.loops, inputs.keyframes_before_loops, map.keyframes);
    quality.readout = estimateReadoutTime(map, inputs.trajectory);
    const std::string shutter = rollingShutterFinding(quality);
    if (!shutter.empty()) sayWarning(shutter);
    if (run.start) return;  // only the new keyframes were looked at
    const SurfaceSpread spread = surfaceSpread(run.level.surfacesInWorld(inputs));
    if (spread.surfaces > 0) quality.spread = spread;
    if (run.depth_shares.empty()) return;
    quality.depth_median = percentileOf(run.depth_shares, 0.5);
    quality.depth_p05 = percentileOf(run.depth_shares, 0.05);
}

/** Their scans are in the grid. */
void noteLasersAsUsed(JobReport& report) {
    for (SensorRecord& sensor : report.sensors) {
        sensor.used |= sensor.class_name == "CObservation2DRangeScan";
    }
}

bool hasLabels(const std::vector<SensorRecord>& sensors) {
    return std::any_of(sensors.begin(), sensors.end(),
                       [](const SensorRecord& sensor) { return isLabelSensor(sensor.label); });
}

void writeLabels(RunState& run, const MapInputs& upright) {
    const JobOptions& options = run.job.options;
    writeSemanticMaps(upright, options.maps, options.semantics, run.job.out_folder);
    for (SensorRecord& sensor : run.report.sensors) sensor.used |= isLabelSensor(sensor.label);
}

void writeMap(RunState& run) {
    writeTextAtomically(pathOf(run, "covisibility.csv"),
                        covisibilityCsv(run.report.covisibility_edges));
    const MapInputs inputs = mapInputs(run);
    if (inputs.keyframes.empty()) refuseEmptyMap(run);
    writeTextAtomically(pathOf(run, frame_entries_name), frameEntriesCsv(entriesOf(inputs)));
    const SE3 T_up_world = run.start ? run.start->T_up_world
                                     : run.level.T_gravity_world(inputs, run.session.T_base_cam());
    MapSnapshot map = run.session.slam().snapshot();
    const ThreadClock quality_clock;
    describeMapQuality(inputs, map, run);
    sayDetail(formatted("figures of quality took %.0f ms", quality_clock.wallMs()));
    MapInputs upright = transformed(T_up_world, inputs);
    upright.up_is_guessed =
        run.start ? upIsGuessed(run.job.map_folder) : tellOfGuessedUp(run.allWarnings());
    writeAllPoses(run, upright, T_up_world);
    run.report.camera = map.rig.cameras.front().model.intrinsics();
    writeSparseMap(pathOf(run, sparse_map_name),
                   {std::move(map), T_up_world, configHash(run.job.options), run.sessions()});
    const ThreadClock clock;
    if (run.job.options.run.dense_maps) {
        const MapSummary maps = writeMaps(upright, run.job.options.maps, run.job.out_folder);
        if (maps.scans > 0) noteLasersAsUsed(run.report);
        const bool has_model = !run.job.options.semantics.model.empty();
        removeSemanticMaps(run.job.out_folder);
        if (has_model || hasLabels(run.report.sensors)) writeLabels(run, upright);
    }
    run.report.maps_wall_s = 1e-3 * clock.wallMs();
}

void writeReport(const RunState& run) {
    const ThreadClock clock;
    writeAtomically(pathOf(run, "keyframes.jpg"), [&](const std::string& temporary) {
        return cv::imwrite(temporary, run.keyframe_sheet.picture(), {cv::IMWRITE_JPEG_QUALITY, 80});
    });
    writeRunReport(run.job.out_folder, run.job.out_folder);
    sayDetail(formatted("report.html took %.0f ms", clock.wallMs()));
}

}  // namespace

void writeRun(RunState& run) {
    const SlamJob& job = run.job;
    writeTextAtomically(pathOf(run, "config.ini"), configText(job.options));
    writeTextAtomically(pathOf(run, "frames.csv"), framesCsv(run.session.slam().frames()));
    writeTextAtomically(pathOf(run, "frame_times.csv"), frameTimesCsv(run.report.frame_times));
    if (run.start && run.located().empty()) {
        throw Error("none of the " + std::to_string(run.report.frames) + " frames of '" +
                        job.rawlog + "' was found in the map of '" + job.map_folder + "'",
                    "check that both show the same place, and the calibration");
    }
    if (job.localizes()) {
        writePoses(run, "trajectory.txt", moved(run.located(), run.start->T_up_world));
    } else {
        writeMap(run);
    }
    run.report.peak_memory_mb = peakMemoryMb();
    run.report.warnings = run.allWarnings();
    writeTextAtomically(pathOf(run, "summary.json"), summaryJson(job, run.report));
    if (!job.localizes()) removePosesOfEarlierRun(run);
    const bool has_keyframes = run.report.keyframes > static_cast<std::size_t>(run.first_keyframe);
    if (!job.localizes() && has_keyframes) writeReport(run);
}

}  // namespace rgbd_graphslam
