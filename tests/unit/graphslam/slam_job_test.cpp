#include "rgbd_graphslam/graphslam/slam_job.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr double turn_rad = 0.02;
constexpr int frames = 30;

class JobOnARawlog : public testing::Test {
  protected:
    JobOnARawlog() {
        setVerbosity(Verbosity::Quiet);
        job_.rawlog = folder_ / "a.rawlog";
        job_.out_folder = folder_ / "out";
        job_.options.run.dense_maps = false;
        write(filmRoundTrip(frames, turn_rad));
    }
    ~JobOnARawlog() override { setVerbosity(Verbosity::Normal); }

    /** With ground truth. */
    void write(const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& film) const {
        writeRawlog(job_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (std::size_t i = 0; i < film.size(); ++i) {
                mrpt::obs::CObservationRobotPose truth;
                truth.sensorLabel = ground_truth_label;
                truth.timestamp = film[i]->timestamp;
                truth.pose.mean = toCPose3D(roundTrip(static_cast<int>(i), turn_rad));
                writer.write(truth);
                writer.write(*film[i]);
            }
        });
    }
    std::string output(const std::string& name) const {
        return readText((fs::path(job_.out_folder) / name).string());
    }
    static std::size_t linesOf(const std::string& text) {
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_F(JobOnARawlog, writesAFolderThatDescribesItself) {
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.tracked, static_cast<std::size_t>(frames));
    ASSERT_TRUE(report.ate_rmse_m);
    EXPECT_LT(*report.ate_rmse_m, 0.01);
    EXPECT_NEAR(report.path_m, 0.5 * turn_rad * (frames - 1), 0.05);

    EXPECT_EQ(linesOf(output("trajectory.txt")), 1u + frames);
    EXPECT_EQ(linesOf(output("keyframes.txt")), 1 + report.keyframes);
    EXPECT_EQ(linesOf(output("frames.csv")), 1u + frames);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    EXPECT_EQ(summary["tracked"], frames);
    EXPECT_EQ(summary["rawlog"], job_.rawlog);
    EXPECT_EQ(summary["config_hash"], configHash(job_.options));
    EXPECT_EQ(summary["ate"]["rmse_m"], *report.ate_rmse_m);
    EXPECT_EQ(summary["stages"]["extract"]["calls"], frames);
    EXPECT_TRUE(fs::exists(job_.out_folder + "/graph.graph"));
}

TEST_F(JobOnARawlog, truthIsWrittenWhereThePathLies) {
    runSlamJob(job_);
    const Trajectory truth = readTumTrajectory(job_.out_folder + "/truth.txt");
    const Trajectory path = readTumTrajectory(job_.out_folder + "/trajectory.txt");
    ASSERT_EQ(truth.size(), path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_EQ(truth[i].stamp_s, path[i].stamp_s);
        EXPECT_LT((truth[i].T_world_cam.t - path[i].T_world_cam.t).norm(), 0.02);
        EXPECT_LT((truth[i].T_world_cam.R - path[i].T_world_cam.R).norm(), 0.05);
    }
}

TEST_F(JobOnARawlog, reportTellsOfTheRunAndItsWarnings) {
    auto film = filmRoundTrip(frames, turn_rad);
    film[10]->timestamp = film[9]->timestamp;
    write(film);
    runSlamJob(job_);
    const auto summary = nlohmann::json::parse(output("summary.json"));
    ASSERT_FALSE(summary["warnings"].empty());
    EXPECT_NE(summary["warnings"][0].get<std::string>().find("not later"), std::string::npos);
    const std::string page = output("report.html");
    EXPECT_NE(page.find("is not later than the one before"), std::string::npos);
    EXPECT_NE(page.find("29 / 29"), std::string::npos);
    EXPECT_NE(page.find("data:image/jpeg;base64,"), std::string::npos);  // of keyframes
}

TEST_F(JobOnARawlog, effectiveConfigRunsTheSameJobAgain) {
    job_.options.slam.tracker.min_inliers = 30;
    runSlamJob(job_);
    JobOptions read;
    IniFile::fromFile(job_.out_folder + "/config.ini").load(read.all());
    EXPECT_EQ(configHash(read), configHash(job_.options));
}

TEST_F(JobOnARawlog, trajectoryDoesNotDependOnThreads) {
    job_.options.run.threads = 1;
    runSlamJob(job_);
    const std::string alone = output("trajectory.txt"), graph = output("graph.graph");
    for (const int threads : {2, 4}) {
        job_.options.run.threads = threads;
        runSlamJob(job_);
        EXPECT_EQ(output("trajectory.txt"), alone);
        EXPECT_EQ(output("graph.graph"), graph);
    }
}

TEST_F(JobOnARawlog, framesThatGoBackAreLeftOutAndCounted) {
    auto film = filmRoundTrip(frames, turn_rad);
    film[10]->timestamp = film[9]->timestamp;
    film[20]->timestamp = film[5]->timestamp;
    write(film);
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.out_of_order, 2u);
    EXPECT_EQ(report.frames, static_cast<std::size_t>(frames - 2));
    EXPECT_EQ(report.lost, 0u);
}

TEST_F(JobOnARawlog, cutRawlogGivesWhatCameBefore) {
    cutFile(job_.rawlog, 0.55);
    const JobReport report = runSlamJob(job_);
    EXPECT_NE(report.damage.find("cut off"), std::string::npos);
    EXPECT_GE(report.frames, static_cast<std::size_t>(frames / 2 - 1));
    EXPECT_EQ(linesOf(output("trajectory.txt")), 1 + report.frames);
}

TEST_F(JobOnARawlog, maxFramesStopsEarly) {
    job_.options.run.max_frames = 7;
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.frames, 7u);
    EXPECT_TRUE(report.damage.empty());
}

TEST_F(JobOnARawlog, nothingToSeeIsAnErrorThatSaysSo) {
    auto film = filmRoundTrip(3, turn_rad);
    for (auto& frame : film) setColor(*frame, cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(90)));
    write(film);
    try {
        runSlamJob(job_);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("could start a map"), std::string::npos) << e.what();
    }
    EXPECT_EQ(linesOf(output("frames.csv")), 4u);
}

TEST_F(JobOnARawlog, denseMapsAreMade) {
    job_.options.run.dense_maps = true;
    runSlamJob(job_);
    for (const char* name : {"points.ply", "octree.bt", "octree.ot", "grid.gridmap.gz",
                             "map.simplemap", "scene.3Dscene"}) {
        EXPECT_TRUE(fs::exists(job_.out_folder + "/" + name)) << name;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
