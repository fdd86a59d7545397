/** Maps of real clips, taken up again: frames that the map was not made of are found in it. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"
#include "rgbd_graphslam/input/frame_stream.h"
#include "rgbd_graphslam/input/rawlog_source.h"
#include "rgbd_graphslam/job/slam_job.h"
#include "rgbd_graphslam/job/sparse_map_file.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

struct Clip {
    const char* name;
    double f, cx, cy;
    /** From the straight line between its neighbors; the last camera is fast and half blind. */
    double max_detour_m;
};

std::ostream& operator<<(std::ostream& out, const Clip& clip) {
    return out << clip.name;
}

const Clip clips[] = {{"kitchen-300", 526.5, 321.1, 238.3, 0.05},
                      {"icl-livingroom-110", 525, 319.5, 239.5, 0.05},
                      {"realsense-desk-250", 615.3, 321.25, 244.25, 0.15}};

std::string dataFolder() {
    const char* given = std::getenv("RGBD_DATA");
    return given ? given : RGBD_SOURCE_DIR "/../shared/data";
}

/** Entries with an even or an odd place in the list. */
template <class Entries>
Entries everySecond(const Entries& entries, std::size_t first) {
    Entries half;
    for (std::size_t i = first; i < entries.size(); i += 2) half.push_back(entries[i]);
    return half;
}

double percentile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

class MapOfEvenFrames : public testing::TestWithParam<Clip> {
  protected:
    void SetUp() override {
        const std::string clip = dataFolder() + "/" + GetParam().name;
        if (!fs::exists(clip)) GTEST_SKIP() << "no clip in " << clip;
        setVerbosity(Verbosity::Quiet);
        importHalf(clip, 0, folder_ / "even.rawlog");
        importHalf(clip, 1, folder_ / "odd.rawlog");
        job_.rawlog = folder_ / "even.rawlog";
        job_.out_folder = folder_ / "even";
        job_.options.run.dense_maps = false;
        runSlamJob(job_);
    }
    void importHalf(const std::string& clip, std::size_t first, const std::string& rawlog) const {
        RgbdSequence sequence = readTumSequence(clip);
        sequence.color = everySecond(sequence.color, first);
        sequence.depth = everySecond(sequence.depth, first);
        CameraSetup setup;
        setup.camera =
            Intrinsics{640, 480, GetParam().f, GetParam().f, GetParam().cx, GetParam().cy, {}};
        setup.depth_units = 1000;
        importSequence(sequence, setup, rawlog, {});
    }
    /** Poses of even frames lie before and after each odd one. */
    void expectBetweenNeighbors(const StampedPose& found, const Trajectory& even,
                                const SE3& T_even_found) const {
        const auto after = std::lower_bound(
            even.begin(), even.end(), found.stamp_s,
            [](const StampedPose& pose, double stamp_s) { return pose.stamp_s < stamp_s; });
        if (after == even.begin() || after == even.end()) return;
        const SE3 &from = (after - 1)->T_world_cam, &to = after->T_world_cam;
        const Eigen::Vector3d middle = interpolate(from, to, 0.5).t;
        EXPECT_LT(((T_even_found * found.T_world_cam).t - middle).norm(), GetParam().max_detour_m)
            << found.stamp_s;
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_P(MapOfEvenFrames, holdsTheOddOnes) {
    job_.rawlog = folder_ / "odd.rawlog";
    job_.map_folder = folder_ / "even";
    job_.out_folder = folder_ / "odd";
    const JobReport report = runSlamJob(job_);
    EXPECT_GE(report.tracked + report.recovered, 0.95 * report.frames);
    const auto even = readTumTrajectory(folder_ / "even/trajectory.txt");
    for (const StampedPose& pose : readTumTrajectory(folder_ / "odd/trajectory.txt")) {
        expectBetweenNeighbors(pose, even, SE3());
    }
}

/** Each odd frame without any idea of its pose: as the first of a run. */
TEST_P(MapOfEvenFrames, anyFrameIsRecognizedAlone) {
    const SparseMap map = readSparseMap(folder_ / "even/map.sparse");
    FrameStream stream(std::make_unique<RawlogSource>(folder_ / "odd.rawlog"), ReadAhead());
    const SlamOptions options;
    const CameraModel camera = cameraOf(stream.firstFrame());
    const VisualSlam extractor(options, camera);
    stream.start([&](const auto& images) { return extractor.prepare(images); });
    const auto even = readTumTrajectory(folder_ / "even/trajectory.txt");
    int frames = 0, recognized = 0;
    std::vector<double> cpu_ms;
    while (auto frame = stream.next()) {
        VisualSlam slam(options, camera, map.snapshot, MapUse::Localize);
        const TrackedFrame found = slam.track(std::move(frame->prepared));
        ++frames;
        for (const auto& stage : slam.stageTimes()) {
            if (stage.stage == "relocalize") cpu_ms.push_back(stage.cpu_ms.front());
        }
        if (found.origin != FrameOrigin::Recovered) continue;
        ++recognized;
        expectBetweenNeighbors({found.stamp_s, found.T_world_cam}, even, map.T_up_world);
    }
    stream.stop();
    EXPECT_GE(recognized, 0.95 * frames);
    ASSERT_EQ(cpu_ms.size(), static_cast<std::size_t>(frames));
    RecordProperty("recognized", std::to_string(recognized) + " of " + std::to_string(frames));
    std::printf("%s: %d of %d recognized alone, CPU p50 %.1f ms, p95 %.1f ms\n", GetParam().name,
                recognized, frames, percentile(cpu_ms, 0.5), percentile(cpu_ms, 0.95));
#ifndef __SANITIZE_ADDRESS__  // which takes its own time
    EXPECT_LE(percentile(cpu_ms, 0.95), 50);
#endif
}

INSTANTIATE_TEST_SUITE_P(Clips, MapOfEvenFrames, testing::ValuesIn(clips));

}  // namespace
}  // namespace rgbd_graphslam
