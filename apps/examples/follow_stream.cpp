/** Follows a live stream: one thread delivers frames at their own pace, another tracks them, and
 *  callbacks report. The stream here is a recording. Usage: example_follow_stream RAWLOG [SPEED] */
#include <rgbd_graphslam/core/error.h>
#include <rgbd_graphslam/dataset/mrpt_conversions.h>
#include <rgbd_graphslam/dataset/rawlog_reader.h>
#include <rgbd_graphslam/graphslam/live_slam.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

using namespace rgbd_graphslam;
using mrpt::obs::CObservation3DRangeScan;

/** \return nothing at the end */
CObservation3DRangeScan::Ptr nextFrame(RawlogReader& rawlog) {
    while (const auto entry = rawlog.next()) {
        if (auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(entry)) return frame;
    }
    return {};
}

int main(int argc, char** argv) try {
    if (argc < 2) throw Error("missing argument RAWLOG");
    const double speed = argc > 2 ? std::atof(argv[2]) : 1;
    RawlogReader rawlog(argv[1]);
    const auto first = nextFrame(rawlog);
    if (!first) throw Error("no RGB-D frame in the rawlog");

    GraphSlamSession session(SlamOptions(), *first);
    LiveSlamCallbacks callbacks;
    callbacks.on_keyframe = [](const TrackedFrame& frame) {
        const Eigen::Vector3d& p = frame.T_world_cam.t;
        std::printf("keyframe %d at %.2f %.2f %.2f m\n", *frame.keyframe, p.x(), p.y(), p.z());
    };
    callbacks.on_loop = [](const PoseEdge& loop) {
        std::printf("loop from keyframe %d to %d, %d inliers\n", loop.from, loop.to, loop.inliers);
    };
    LiveSlam slam(session, callbacks);

    std::thread camera([&] {
        const auto start = std::chrono::steady_clock::now();
        for (auto frame = first; frame; frame = nextFrame(rawlog)) {
            const std::chrono::duration<double> due(
                (toSeconds(frame->timestamp) - toSeconds(first->timestamp)) / speed);
            std::this_thread::sleep_until(start + due);
            slam.push(frame);
        }
    });
    camera.join();
    slam.finish();
    std::printf("%zu frames tracked, %zu dropped\n", session.slam().frames().size(),
                slam.dropped());
} catch (const Error& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
}
