#include "rgbd_graphslam/job/slam_job.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cameraless_job.h"
#include "checkpoint.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/live/viewer_launch.h"
#include "run_checkpoint.h"
#include "run_description.h"
#include "run_output.h"
#include "run_state.h"
#include "tracking_loop.h"

namespace rgbd_graphslam {
namespace {

/** \throws Error when the way of a localized run would replace that of the run that made the map */
void checkFolders(const SlamJob& job) {
    std::error_code none_yet;
    if (!job.localizes()) return;
    if (!std::filesystem::equivalent(job.map_folder, job.out_folder, none_yet)) return;
    throw Error("'" + job.out_folder +
                    "' holds the map to be localized in, whose files this run would replace",
                "choose another output folder");
}

/** \throws Error when the job is strict and the recording makes a wrong map */
void tellOfRecording(const RunState& run) {
    sayDetail("depth: " + toText(run.survey.depth()));
    const std::string cameras = severalCamerasText(run.stream.sensors());
    if (!cameras.empty()) sayInfo("cameras: " + cameras + "; --sensor LABEL chooses another");
    for (const SurveyWarning& warning :
         run.survey.warnings(run.job.options.slam.features, run.job.options.maps)) {
        if (run.job.strict && warning.refuses) {
            throw Error("refused by --strict: " + warning.text,
                        "run without --strict to map it all the same");
        }
        sayWarning(warning.text);
    }
}

std::optional<SparseMap> readStart(const SlamJob& job) {
    if (job.map_folder.empty() || job.resume) return std::nullopt;
    return readSparseMap(job.map_folder + "/" + sparse_map_name);
}

/** Whether the run in a folder has come to its end. */
bool isComplete(const std::string& folder) {
    if (std::filesystem::exists(checkpointPath(folder))) return false;
    std::ifstream in(folder + "/summary.json");
    const auto summary = nlohmann::json::parse(in, nullptr, false);
    return summary.is_object() && summary.value("interrupted", nlohmann::json()) == false;
}

/** Sensors are let go, the record is completed. */
void endLiveRun(RunState& run) {
    LiveSource& live = *run.job.live;
    live.end();
    run.stream.stop();
    run.report.live = live.statistics();
    bool& dense_maps = run.job.options.run.dense_maps;
    if (live.finishRecord() || !dense_maps || run.job.localizes()) return;
    sayWarning("no maps: they are made of the record, and there is none");
    dense_maps = false;
}

}  // namespace

SlamJob resumedJob(const std::string& out_folder) {
    if (isComplete(out_folder)) {
        throw Error("the run in '" + out_folder + "' is already complete (no checkpoint)",
                    "nothing to resume");
    }
    SlamJob job = readCheckpoint(out_folder).job;
    job.resume = true;
    return job;
}

JobReport runSlamJob(const SlamJob& job) {
    checkFolders(job);
    if (!job.resume && !job.live) {
        if (const auto report = runWithoutCamera(job)) return *report;
    }
    auto start = readStart(job);
    makeWritableFolder(job.out_folder);
    RunState run(job, std::move(start));
    TrackingLoop loop(run);
    if (job.resume) {
        goOnFromCheckpoint(run);
    } else {
        tellOfRecording(run);
    }
    CheckpointWriter checkpoints(run.job, run.progress());
    if (!job.resume) checkpoints.remove();  // of an earlier run
    if (job.view) launchViewer(job.out_folder);
    loop.track(checkpoints);
    if (job.live) endLiveRun(run);
    const bool can_go_on = loop.interrupted() && checkpoints.enabled();
    if (can_go_on) writeCheckpoint(run, checkpoints);
    run.session.finish();
    run.sensors.conclude(run.session.slam());
    run.report.interrupted = loop.interrupted() && !job.live;
    describeRun(run);
    writeRun(run);
    if (can_go_on) {
        sayInfo("interrupted; --resume " + job.out_folder + " goes on from here");
    } else {
        checkpoints.remove();
    }
    return run.report;
}

}  // namespace rgbd_graphslam
