#include "run_checkpoint.h"

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

void save(const RunState& run, ByteWriter& out) {
    out.putCount(run.frames_read);
    out.putCount(run.first_keyframe);
    out.putCount(run.T_previous_keyframe.size());
    for (const SE3& pose : run.T_previous_keyframe) encodePose(pose, out);
    out.put(run.report.tracking_wall_s);
    out.put(run.report.tracking_cpu_s);
    out.putCount(run.report.frame_times.size());
    for (const FrameTime& time : run.report.frame_times) {
        out.put(time.stamp_s);
        out.put(time.wall_ms);
    }
    const auto warnings = run.allWarnings();
    out.putCount(warnings.size());
    for (const std::string& warning : warnings) out.putText(warning);
    putFlag(run.start.has_value(), out);
    if (run.start) {
        encodePose(run.start->T_up_world, out);
        encode(run.start->sessions, out);
    }
    run.sensors.save(out);
    run.session.save(out);
}

void load(ByteReader& in, RunState& run) {
    run.frames_read = in.get<std::uint32_t>();
    run.first_keyframe = in.get<std::int32_t>();
    run.T_previous_keyframe.resize(in.getCount(pose_bytes));
    for (SE3& pose : run.T_previous_keyframe) pose = decodePose(in);
    run.report.tracking_wall_s = getFinite(in);
    run.report.tracking_cpu_s = getFinite(in);
    run.report.frame_times.resize(in.getCount(2 * sizeof(double)));
    for (FrameTime& time : run.report.frame_times) {
        time.stamp_s = getFinite(in);
        time.wall_ms = getFinite(in);
    }
    run.earlier_warnings.resize(in.getCount(sizeof(std::uint32_t)));
    for (std::string& warning : run.earlier_warnings) warning = in.getText();
    if (getFlag(in)) {
        run.start.emplace().T_up_world = decodePose(in);
        run.start->sessions = decodeSessions(in);
    }
    run.sensors.load(in);
    run.session.load(in);
    const std::size_t keyframes = run.session.slam().keyframes().size();
    if (run.T_previous_keyframe.size() != keyframes) {
        throw DamagedBytes("motions of keyframes that are not there");
    }
    requireInOrder(run.sessions(), keyframes);
    if (in.left() > 0) throw DamagedBytes("there is more than a state");
}

void readOver(RunState& run) {
    const std::vector<TrackedFrame> tracked = run.session.slam().frames();
    auto known = tracked.begin();
    for (std::size_t i = 0; i < run.frames_read; ++i) {
        const auto frame = run.stream.skip();
        if (!frame) throw Error("the rawlog '" + run.job.rawlog + "' ends before its checkpoint");
        for (const auto& observation : frame->before) {
            run.level.note(*observation);
            run.sensors.note(*observation);
        }
        const bool left_out =
            known == tracked.end() || toSeconds(frame->observation->timestamp) != known->stamp_s;
        if (left_out) continue;
        if (!run.first_stamp_s) run.first_stamp_s = known->stamp_s;
        run.last_stamp_s = known->stamp_s;
        run.noteEntry(*frame);
        if (known->keyframe) run.keepPictures(*known->keyframe, frame->observation);
        ++known;
    }
    run.report.frames = tracked.size();
    run.report.out_of_order = run.frames_read - tracked.size();
}

}  // namespace

std::string encodeRun(const RunState& run) {
    ByteWriter out;
    save(run, out);
    return out.take();
}

void writeCheckpoint(const RunState& run, CheckpointWriter& writer) {
    const ThreadClock clock;
    std::string state = encodeRun(run);
    sayDetail(formatted("checkpoint: %zu kB in %.1f ms", state.size() / 1000, clock.cpuMs()));
    writer.write(run.progress(), std::move(state));
}

void goOnFromCheckpoint(RunState& run) {
    goOnFrom(readCheckpoint(run.job.out_folder).state, run);
}

void goOnFrom(const std::string& state, RunState& run) {
    try {
        ByteReader in(state);
        load(in, run);
    } catch (const DamagedBytes& e) {
        throw Error("the checkpoint in '" + run.job.out_folder + "' makes no sense: " + e.what(),
                    "run it from the start");
    }
    readOver(run);
    sayInfo("goes on at frame " + std::to_string(run.frames_read) + " with " +
            std::to_string(run.T_previous_keyframe.size()) + " keyframes");
}

}  // namespace rgbd_graphslam
