#include "run_description.h"

#include <algorithm>
#include <map>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/report/run_findings.h"
#include "truth_comparison.h"

namespace rgbd_graphslam {
namespace {

/** The submap with most of the frames. */
int largestSubmap(const std::vector<TrackedFrame>& frames) {
    std::map<int, int> count;
    for (const TrackedFrame& frame : frames)
        count[frame.submap] += frame.origin != FrameOrigin::Lost;
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto most = std::max_element(count.begin(), count.end(), fewer);
    return most == count.end() ? 0 : most->first;
}

double pathLength(const Trajectory& trajectory) {
    double length = 0;
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
        length += (trajectory[i].T_world_cam.t - trajectory[i - 1].T_world_cam.t).norm();
    }
    return length;
}

void countFrames(RunState& run) {
    JobReport& report = run.report;
    for (const TrackedFrame& frame : run.session.slam().frames()) {
        report.tracked += frame.origin == FrameOrigin::Tracked;
        report.recovered += frame.origin == FrameOrigin::Recovered;
        report.dead_reckoned += frame.origin == FrameOrigin::DeadReckoned;
        report.uncertain += frame.origin == FrameOrigin::Uncertain;
        report.lost += frame.origin == FrameOrigin::Lost;
        report.disconnected += frame.origin != FrameOrigin::Lost && run.disconnected(frame.submap);
    }
    if (report.disconnected == 0) return;
    sayWarning(std::to_string(report.disconnected) +
               " frames are in submaps that no loop has joined with the rest: they "
               "have no pose in trajectory.txt");
}

void describeMap(RunState& run) {
    const VisualSlam& slam = run.session.slam();
    for (const KeyframeView& keyframe : slam.keyframes()) {
        ++run.report.keyframes;
        run.report.culled_keyframes += keyframe.culled;
        if (run.disconnected(keyframe.submap))
            run.report.disconnected_keyframes.push_back(keyframe.id);
    }
    run.report.landmarks = slam.landmarks().size();
    for (const PoseEdge& edge : slam.poseGraph().edges) {
        if (edge.kind == EdgeKind::Covisibility) run.report.covisibility_edges.push_back(edge);
    }
}

void describeSensors(RunState& run) {
    run.report.sensors = run.stream.sensors();
    const std::string cameras = severalCamerasText(run.report.sensors);
    if (cameras.empty() || !run.job.sensor_label.empty()) return;
    const std::string first = run.stream.rig().cameras.front().label;
    const bool all_used =
        std::all_of(run.report.sensors.begin(), run.report.sensors.end(),
                    [](const SensorRecord& sensor) { return sensor.used || !sensor.isCamera(); });
    const std::string text = "the rawlog has several RGB-D cameras: " + cameras;
    if (all_used) {
        sayInfo(text + "; tracked as one rig, dense maps are made of '" + first + "'");
    } else {
        sayWarning(text + "; --sensor LABEL chooses another");
    }
}

/** Runs of earlier versions have none; their frames are known by their stamps. */
std::vector<FrameEntries> earlierEntries(const std::string& map_folder) {
    try {
        return readFrameEntries(map_folder + "/" + frame_entries_name);
    } catch (const Error& e) {
        sayWarning(e.what());
        return {};
    }
}

void describeEarlierSessions(RunState& run) {
    const auto all = run.sessions();
    if (all.size() < 2) return;
    auto entries = earlierEntries(run.job.map_folder);
    entries.resize(all.size() - 1);
    for (std::size_t s = 0; s + 1 < all.size(); ++s) {
        const int keyframes = all[s + 1].first_keyframe - all[s].first_keyframe;
        run.report.earlier.push_back({all[s].rawlog, static_cast<std::size_t>(keyframes),
                                      all[s].sensor_label, std::move(entries[s])});
    }
}

/** Of the camera, in the truth's own world. */
Trajectory truthOf(const RunState& run) {
    Trajectory truth = run.stream.truth();
    for (StampedPose& pose : truth) pose.T_world_cam = pose.T_world_cam * run.session.T_base_cam();
    return truth;
}

/** The truth is of this rawlog only, whatever stamps the keyframes of an earlier session have. */
void describeLoops(const Trajectory& truth, RunState& run) {
    JobReport& report = run.report;
    const std::vector<KeyframeView> keyframes = run.session.slam().keyframes();
    for (const PoseEdge& edge : run.session.slam().loops()) {
        ReportedLoop loop{edge.from, edge.to, edge.inliers, std::nullopt};
        if (std::min(edge.from, edge.to) >= run.first_keyframe) {
            loop.error_m =
                edgeErrorM(edge, keyframes[edge.from].stamp_s, keyframes[edge.to].stamp_s, truth);
        }
        report.loops.push_back(loop);
    }
    if (truth.empty()) return;
    const auto is_false = [](const ReportedLoop& loop) {
        return loop.error_m && *loop.error_m > false_loop_m;
    };
    report.false_loops = std::count_if(report.loops.begin(), report.loops.end(), is_false);
}

void evaluate(const Trajectory& estimate, const Trajectory& truth, RunState& run) {
    const auto comparison = compareWithTruth(estimate, truth);
    if (!comparison) return;
    run.report.ate_rmse_m = comparison->ate.translation_m.rmse;
    run.report.ate_pairs = comparison->ate.pairs.size();
    run.report.ate_fitted_scale = comparison->ate.fitted_scale;
    const std::string scale = depthScaleFinding(comparison->ate);
    if (!scale.empty()) sayWarning(scale);
    run.truth = comparison->truth;
}

void collectStages(RunState& run) {
    run.report.stages = run.stream.times().all();
    const auto of_session = run.session.slam().stageTimes();
    run.report.stages.insert(run.report.stages.end(), of_session.begin(), of_session.end());
}

}  // namespace

void describeRun(RunState& run) {
    const VisualSlam& slam = run.session.slam();
    describeSensors(run);
    run.submap = run.start ? slam.keyframes().front().submap : largestSubmap(slam.frames());
    countFrames(run);
    describeEarlierSessions(run);
    describeMap(run);
    const Trajectory estimate = run.located(), truth = truthOf(run);
    run.report.path_m = pathLength(estimate);
    describeLoops(truth, run);
    evaluate(estimate, truth, run);
    run.report.quality = frameQuality(slam.frames());
    run.report.motion = slam.motion();
    run.report.imu_delay = run.sensors.gyroscopeDelay();
    run.report.quality.loops = loopResiduals(slam.loops(), slam.keyframes());
    collectStages(run);
}

}  // namespace rgbd_graphslam
