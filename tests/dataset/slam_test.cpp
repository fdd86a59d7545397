/** rgbd-slam's job on real clips: every frame tracked, within the bounds of accuracy, the same
 *  whatever the number of threads. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>

#include "../support/problem_of.h"
#include "../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"
#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

struct Clip {
    const char* name;
    CameraSetup setup;
    std::size_t frames;
    std::optional<double> max_ate_m;
};

std::ostream& operator<<(std::ostream& out, const Clip& clip) {
    return out << clip.name;
}

CameraSetup pinhole(double fx, double fy, double cx, double cy, int width = 640, int height = 480) {
    CameraSetup setup;
    setup.camera = Intrinsics{width, height, fx, fy, cx, cy, {}};
    setup.depth_units = 1000;
    return setup;
}

const Clip clips[] = {
    {"kitchen-300", pinhole(526.5, 526.5, 321.1, 238.3), 300, 0.08},
    {"icl-livingroom-110", pinhole(525, 525, 319.5, 239.5), 110, 0.01},
    {"realsense-desk-250", pinhole(615.23, 615.46, 321.25, 244.25), 250, 0.03},
    {"arm-box-50", pinhole(615.2, 615.2, 298.44, 247.52), 50, 0.006},
    // The camera stands still, and a person walks by.
    {"kinect-fixed-person-180", pinhole(262.5, 262.5, 159.75, 119.75, 320, 240), 180, 0.004},
    {"tum-fr2-pioneer-50", *cameraByName("fr2"), 50, {}},
    {"tum-fr1-desk-9", *cameraByName("fr1"), 9, 0.01},
};

std::string dataFolder() {
    const char* given = std::getenv("RGBD_DATA");
    return given ? given : RGBD_SOURCE_DIR "/../shared/data";
}

class SlamOnClip : public testing::TestWithParam<Clip> {
  protected:
    void SetUp() override {
        const std::string clip = dataFolder() + "/" + GetParam().name;
        if (!fs::exists(clip)) GTEST_SKIP() << "no clip in " << clip;
        setVerbosity(Verbosity::Quiet);
        job_.rawlog = folder_ / "clip.rawlog";
        job_.out_folder = folder_ / "out";
        job_.options.run.dense_maps = false;
        importSequence(readTumSequence(clip), GetParam().setup, job_.rawlog, {});
    }
    std::string trajectoryWith(int threads) {
        job_.options.run.threads = threads;
        report_ = runSlamJob(job_);
        return readText(job_.out_folder + "/trajectory.txt");
    }

    TestFolder folder_;
    SlamJob job_;
    JobReport report_;
};

TEST_P(SlamOnClip, isTrackedThroughoutAndTheSameEachTime) {
    const std::string alone = trajectoryWith(1);
    EXPECT_EQ(report_.tracked, GetParam().frames);
    EXPECT_EQ(report_.lost + report_.recovered, 0u);
    ASSERT_EQ(report_.ate_rmse_m.has_value(), GetParam().max_ate_m.has_value());
    if (GetParam().max_ate_m) {
        EXPECT_LE(*report_.ate_rmse_m, *GetParam().max_ate_m);
    }
    for (const int threads : {2, 4}) EXPECT_EQ(trajectoryWith(threads), alone) << threads;
}

INSTANTIATE_TEST_SUITE_P(Clips, SlamOnClip, testing::ValuesIn(clips));

/** Depth of a camera with 385 px of focal length, taken as if it were that of color with 603 px.
 */
TEST(UnregisteredClip, isRefusedByAStrictJob) {
    const std::string clip = dataFolder() + "/realsense-unregistered-40";
    if (!fs::exists(clip)) GTEST_SKIP() << "no clip in " << clip;
    setVerbosity(Verbosity::Quiet);
    const TestFolder folder;
    SlamJob job;
    job.rawlog = folder / "clip.rawlog";
    job.out_folder = folder / "out";
    job.strict = true;
    importSequence(readTumSequence(clip), pinhole(603, 603, 325, 235), job.rawlog, {});
    EXPECT_THAT(problemOf([&] { runSlamJob(job); }),
                testing::HasSubstr("never registered to color"));
}

}  // namespace
}  // namespace rgbd_graphslam
