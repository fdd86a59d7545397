/** A run that goes on from any state of a checkpoint: what is accepted must carry it to the end. */
#include "../../libs/job/src/checkpoint.h"
#include "../../libs/job/src/run_checkpoint.h"
#include "../support/textured_room.h"
#include "../support/tum_folder.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {

constexpr int frames = 14;

mrpt::obs::CObservation3DRangeScan::Ptr smallFrame(const SE3& T_world_base, double stamp_s) {
    static const TexturedRoom room;
    static const CameraSetup setup = [] {
        CameraSetup half = room.setup();
        half.camera = CameraModel(half.camera).shrunk(2).intrinsics();
        return half;
    }();
    const RgbdImage image = toRgbdImage(room.film(T_world_base, stamp_s));
    const cv::Size size(setup.camera.width, setup.camera.height);
    cv::Mat color, depth;
    cv::resize(image.color, color, size, 0, 0, cv::INTER_AREA);
    cv::resize(image.depth, depth, size, 0, 0, cv::INTER_NEAREST);
    auto frame = makeRgbdObservation(setup, stamp_s);
    setColor(*frame, color.clone());
    setDepth(*frame, depth);
    return frame;
}

/** Along one wall, covered for a moment, and on along another, which becomes a part of its own. */
void writeFilm(const std::string& rawlog) {
    writeRawlog(rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (int i = 0; i < frames; ++i) {
            const int place = i < frames / 2 ? i : i + 30;
            const auto frame = smallFrame(roundTrip(place, 0.05), room_start_s + i * room_period_s);
            writer.write(*frame);
        }
    });
}

/** Few features and a keyframe at every other frame, so that a state is small and has all parts. */
const SlamJob& smallJob() {
    static const TestFolder folder;
    static const SlamJob only = [] {
        setVerbosity(Verbosity::Quiet);
        SlamJob job;
        job.rawlog = folder / "a.rawlog";
        job.out_folder = folder / "out";
        job.options.run.threads = 1;
        job.options.slam.features.count = 55;
        job.options.slam.features.levels = 3;
        job.options.slam.tracker.min_inliers = 12;
        job.options.slam.keyframes.max_rotation_rad = 0.08;
        job.options.slam.recovery.new_submap_after = 2;
        job.options.slam.recovery.fewest_keypoints = 40;
        writeFilm(job.rawlog);
        return job;
    }();
    return only;
}

/** \param most frames that are tracked now */
void track(RunState& run, int most) {
    run.stream.start(
        [&session = run.session](const auto& images) { return session.prepare(images); });
    for (int i = 0; i < most; ++i) {
        const auto frame = run.stream.next();
        if (!frame) break;
        ++run.frames_read;
        run.last_stamp_s = frame->prepared.stamp_s;
        if (!run.first_stamp_s) run.first_stamp_s = run.last_stamp_s;
        run.report.frame_times.push_back({frame->prepared.stamp_s, 1.5});
        const TrackedFrame tracked = run.session.step(frame->observation, frame->prepared);
        if (!tracked.keyframe) continue;
        run.noteKeyframe(*tracked.keyframe);
        run.keepPictures(*tracked.keyframe, frame->observation);
    }
}

}  // namespace

void fuzzCheckpoint(const std::string& bytes) {
    RunState run(smallJob(), std::nullopt);
    try {
        goOnFrom(bytes, run);
        track(run, frames);
    } catch (const Error&) {
        return;
    }
    encodeRun(run);
    run.session.finish();
    run.located();
}

std::vector<std::string> checkpointSeeds() {
    std::vector<std::string> seeds;
    for (const int tracked : {5, frames - 3}) {
        RunState run(smallJob(), std::nullopt);
        track(run, tracked);
        seeds.push_back(encodeRun(run));
    }
    return seeds;
}

std::string goneOnAndSaved(const std::string& state) {
    RunState run(smallJob(), std::nullopt);
    goOnFrom(state, run);
    return encodeRun(run);
}

}  // namespace rgbd_graphslam
