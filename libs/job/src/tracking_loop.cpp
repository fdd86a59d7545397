#include "tracking_loop.h"

#include <utility>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "run_checkpoint.h"

namespace rgbd_graphslam {

TrackingLoop::TrackingLoop(RunState& run) : run_(run), live_feed_(run.job.out_folder) {
    if (!run.job.live) return;
    run.job.live->endWhen([this] { return interrupted(); });
    run.session.onPose([this](const TrackedFrame&) { run_.stream.notePose(*tracked_); });
}

TrackingLoop::~TrackingLoop() {
    run_.session.onPose({});
    if (run_.job.live) run_.job.live->endWhen({});
}

void TrackingLoop::track(CheckpointWriter& checkpoints) {
    JobReport& report = run_.report;
    const ThreadClock clock;
    const double cpu_before = processCpuSeconds();
    const double earlier_wall_s = report.tracking_wall_s, earlier_cpu_s = report.tracking_cpu_s;
    Progress progress("tracking", run_.stream.expectedFrames());
    // Frames are read ahead until the stream stops, which may be after this loop is gone.
    run_.stream.start(
        [&session = run_.session](const auto& images) { return session.prepare(images); });
    while (!finished()) {
        auto frame = nextFrame();
        if (!frame) break;
        trackOne(*frame);
        run_.stream.noteTracked(*frame);
        ++run_.frames_read;
        checkLimits();
        report.tracking_wall_s = earlier_wall_s + 1e-3 * clock.wallMs();
        report.tracking_cpu_s = earlier_cpu_s + processCpuSeconds() - cpu_before;
        if (checkpoints.due(run_.progress())) writeCheckpoint(run_, checkpoints);
        progress.expect(run_.stream.expectedFrames());
        progress.update(frame->index + 1, progressNote());
    }
}

bool TrackingLoop::finished() const {
    const auto most = static_cast<std::size_t>(run_.job.options.run.max_frames);
    return interrupted() || !run_.report.limit.empty() || (most > 0 && run_.report.frames >= most);
}

void TrackingLoop::checkLimits() {
    const RunOptions& limits = run_.job.options.run;
    JobReport& report = run_.report;
    const std::size_t keyframes = run_.T_previous_keyframe.size();
    std::string reached;
    if (limits.max_keyframes > 0 && keyframes >= std::size_t(limits.max_keyframes)) {
        reached = "max_keyframes = " + std::to_string(limits.max_keyframes);
    } else if (limits.max_memory_mb > 0 && peakMemoryMb() >= limits.max_memory_mb) {
        reached = "max_memory_mb = " + std::to_string(limits.max_memory_mb);
    }
    if (reached.empty()) return;
    report.limit =
        "the limit " + reached + " is reached after " + std::to_string(report.frames) + " frames";
    sayWarning(report.limit + ", the rest of the rawlog is left out; raise it in [RunOptions]");
}

std::optional<StreamedFrame> TrackingLoop::nextFrame() {
    try {
        return run_.stream.next();
    } catch (const Error& e) {
        run_.report.damage = e.what();
        return std::nullopt;
    }
}

/** Whether the frame is later than the one before; warns of the first that is not. */
bool TrackingLoop::takesItsTurn(const StreamedFrame& frame) {
    const double stamp_s = frame.prepared.stamp_s;
    if (!run_.last_stamp_s || stamp_s > *run_.last_stamp_s) return true;
    if (run_.report.out_of_order++ == 0) {
        sayWarning(
            formatted("frame %zu at %.6f s is not later than the one before; it and all "
                      "others like it are left out",
                      frame.index, stamp_s));
    }
    return false;
}

void TrackingLoop::trackOne(StreamedFrame& frame) {
    for (const auto& observation : frame.before) {
        run_.level.note(*observation);
        run_.sensors.note(*observation);
    }
    if (!takesItsTurn(frame)) return;
    const double stamp_s = frame.prepared.stamp_s;
    run_.last_stamp_s = stamp_s;
    if (!run_.first_stamp_s) run_.first_stamp_s = stamp_s;
    ++run_.report.frames;
    run_.noteEntry(frame);
    const ThreadClock clock;
    run_.sensors.withhold(frame.prepared);
    tracked_ = &frame;
    const TrackedFrame tracked = run_.session.step(frame.observation, std::move(frame.prepared));
    run_.sensors.compareWhenDue(run_.session.slam(), run_.report.frames);
    run_.report.frame_times.push_back({stamp_s, clock.wallMs()});
    live_feed_.note(frame, tracked, run_.report.frame_times.back().wall_ms, run_.session);
    if (!tracked.keyframe) return;
    run_.noteKeyframe(*tracked.keyframe);
    if (frame.camera == 0) run_.keepPictures(*tracked.keyframe, frame.observation);
}

std::string TrackingLoop::progressNote() const {
    const std::size_t loops = run_.session.slam().loops().size();
    return std::to_string(run_.T_previous_keyframe.size()) + " keyframes" +
           (loops > 0 ? ", " + std::to_string(loops) + " loops" : "");
}

}  // namespace rgbd_graphslam
