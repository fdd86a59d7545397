/** Real clips whose color is blackened for half a second: frames are tied in by depth alone. */
#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>

#include "../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"
#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr int first_covered = 60, last_covered = 74;

struct Clip {
    const char* name;
    double f, cx, cy;
    double max_ate_m;
};

std::ostream& operator<<(std::ostream& out, const Clip& clip) {
    return out << clip.name;
}

const Clip clips[] = {{"kitchen-300", 526.5, 321.1, 238.3, 0.08},
                      {"icl-livingroom-110", 525, 319.5, 239.5, 0.01}};

std::string dataFolder() {
    const char* given = std::getenv("RGBD_DATA");
    return given ? given : RGBD_SOURCE_DIR "/../shared/data";
}

void blackenColor(const std::string& from, const std::string& to) {
    writeRawlog(to, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        RawlogReader reader(from);
        int frame = 0;
        while (const auto entry = reader.next()) {
            auto rgbd = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(entry);
            if (rgbd && ++frame > first_covered && frame <= last_covered + 1) {
                setColor(*rgbd, cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(0)));
            }
            writer.write(*entry);
        }
    });
}

class CoveredClip : public testing::TestWithParam<Clip> {
  protected:
    void SetUp() override {
        const Clip& clip = GetParam();
        const std::string folder = dataFolder() + "/" + clip.name;
        if (!fs::exists(folder)) GTEST_SKIP() << "no clip in " << folder;
        setVerbosity(Verbosity::Quiet);
        CameraSetup setup;
        setup.camera = Intrinsics{640, 480, clip.f, clip.f, clip.cx, clip.cy, {}};
        setup.depth_units = 1000;
        importSequence(readTumSequence(folder), setup, folder_ / "clip.rawlog", {});
        job_.rawlog = folder_ / "covered.rawlog";
        job_.out_folder = folder_ / "out";
        job_.options.run.dense_maps = false;
        blackenColor(folder_ / "clip.rawlog", job_.rawlog);
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_P(CoveredClip, isTiedInByDepthAndTheSameForAnyNumberOfThreads) {
    job_.options.run.threads = 1;
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.lost, 0u);
    EXPECT_GE(report.dead_reckoned, 15u);
    EXPECT_LE(report.dead_reckoned, 20u);
    EXPECT_LE(report.ate_rmse_m.value_or(1e9), GetParam().max_ate_m);
    EXPECT_EQ(report.ate_pairs, report.frames);
    const std::string alone = readText(job_.out_folder + "/trajectory.txt");
    for (const int threads : {2, 4}) {
        job_.options.run.threads = threads;
        runSlamJob(job_);
        EXPECT_EQ(readText(job_.out_folder + "/trajectory.txt"), alone) << threads;
    }
}

INSTANTIATE_TEST_SUITE_P(Clips, CoveredClip, testing::ValuesIn(clips));

}  // namespace
}  // namespace rgbd_graphslam
