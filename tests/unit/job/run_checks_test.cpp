/** What a run notices about its recording and its own quality. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "../../support/problem_of.h"
#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/job/slam_job.h"
#include "rgbd_graphslam/mapping/run_folder.h"

namespace rgbd_graphslam {
namespace {
using mrpt::obs::CObservation3DRangeScan;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double turn_rad = 0.02;
constexpr int frames = 30;

using Film = std::vector<CObservation3DRangeScan::Ptr>;

class RunChecks : public testing::Test {
  protected:
    RunChecks() {
        setVerbosity(Verbosity::Quiet);
        job_.rawlog = folder_ / "a.rawlog";
        job_.out_folder = folder_ / "out";
        job_.options.run.dense_maps = false;
    }
    ~RunChecks() override { setVerbosity(Verbosity::Normal); }

    void write(const std::function<void(RawlogWriter&)>& fill) const {
        writeRawlog(job_.rawlog, RawlogStorage::Embedded, fill);
    }
    void write(const Film& film) const {
        write([&](RawlogWriter& writer) {
            for (const auto& frame : film) writer.write(*frame);
        });
    }
    /** The same scene many times as large. */
    static Film enlarged(float factor) {
        Film film = filmRoundTrip(frames, turn_rad);
        for (const auto& frame : film) frame->rangeUnits *= factor;
        return film;
    }
    nlohmann::json summary() const {
        return nlohmann::json::parse(readText(job_.out_folder + "/summary.json"));
    }
    double depthMaxInConfig() const {
        JobOptions written;
        IniFile::fromFile(job_.out_folder + "/config.ini").load(written.all());
        return written.slam.features.depth_max_m;
    }

    TestFolder folder_;
    SlamJob job_;
};

TEST_F(RunChecks, aRoomKeepsTheUsualRangeOfDepth) {
    write(filmRoundTrip(frames, turn_rad));
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(depthMaxInConfig(), 10);
    EXPECT_THAT(report.warnings, Not(Contains(HasSubstr("depth"))));
}

TEST_F(RunChecks, aStreetIsTrackedWithTheRangeItNeeds) {
    write(enlarged(15));
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.tracked, static_cast<std::size_t>(frames));
    EXPECT_GT(depthMaxInConfig(), 20);
    EXPECT_THAT(report.warnings, Not(Contains(HasSubstr("depth_max_m"))));
    EXPECT_THAT(report.warnings, Contains(HasSubstr("MapOptions.max_range_m")));
}

TEST_F(RunChecks, aRangeThatLeavesOutMostReadingsIsToldWithTheOneThatDoesNot) {
    write(enlarged(15));
    job_.options.slam.features.depth_max_m = 10;
    WarningRecord record;
    try {
        runSlamJob(job_);
    } catch (const Error&) {  // what is left may be too little to track
    }
    EXPECT_THAT(record.warnings(), Contains(HasSubstr("beyond depth_max_m = 10")));
    EXPECT_THAT(record.warnings(), Contains(HasSubstr("FeatureOptions.depth_max_m = ")));
}

TEST_F(RunChecks, depthInOtherUnitsIsToldAndRefusedIfStrict) {
    write(enlarged(0.05F));
    WarningRecord record;
    try {
        runSlamJob(job_);
    } catch (const Error&) {  // all of it is too near to be used
    }
    EXPECT_THAT(record.warnings(), Contains(HasSubstr("depth has a median of 0.0")));
    job_.strict = true;
    job_.out_folder = folder_ / "strict";
    EXPECT_THAT(problemOf([&] { runSlamJob(job_); }),
                HasSubstr("refused by --strict: depth has a median of 0.0"));
    EXPECT_FALSE(std::filesystem::exists(job_.out_folder + "/trajectory.txt"));
}

/** Two cameras side by side, the second looking at another part of the room; the laser is of no
 * use. */
class RunWithTwoCameras : public RunChecks {
  protected:
    RunWithTwoCameras() {
        const Film front = filmRoundTrip(frames, turn_rad),
                   rear = filmRoundTrip(2 * frames, turn_rad);
        write([&](RawlogWriter& writer) {
            for (int i = 0; i < frames; ++i) {
                mrpt::obs::CObservation2DRangeScan scan;
                scan.sensorLabel = "LASER";
                writer.write(scan);
                front[i]->sensorLabel = "FRONT";
                writer.write(*front[i]);
                rear[i + frames]->sensorLabel = "REAR";
                rear[i + frames]->timestamp = front[i]->timestamp;
                if (i % 2 == 0) writer.write(*rear[i + frames]);
            }
        });
    }
};

TEST_F(RunWithTwoCameras, theFirstIsTakenAndTheOtherNamed) {
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.frames, static_cast<std::size_t>(frames));
    EXPECT_THAT(report.warnings,
                Contains(HasSubstr("'FRONT' (30 frames, used), 'REAR' (15 frames)")));
    const std::string table = resultTable(job_, report);
    EXPECT_THAT(table, HasSubstr("'FRONT' (CObservation3DRangeScan, 30)"));
    EXPECT_THAT(table, HasSubstr("not used: 'LASER' (CObservation2DRangeScan, 30), 'REAR'"));
}

TEST_F(RunWithTwoCameras, anotherIsChosenByItsLabel) {
    job_.sensor_label = "REAR";
    const JobReport report = runSlamJob(job_);
    EXPECT_EQ(report.frames, static_cast<std::size_t>(frames / 2));
    EXPECT_THAT(report.warnings, Not(Contains(HasSubstr("several RGB-D cameras"))));
    const auto sensors = summary()["sensors"];
    ASSERT_EQ(sensors.size(), 3u);
    EXPECT_EQ(sensors[0]["label"], "LASER");
    EXPECT_EQ(sensors[0]["used"], false);
    EXPECT_EQ(sensors[1]["label"], "FRONT");
    EXPECT_EQ(sensors[1]["used"], false);
    EXPECT_EQ(sensors[2]["class"], "CObservation3DRangeScan");
    EXPECT_EQ(sensors[2]["count"], frames / 2);
    EXPECT_EQ(sensors[2]["used"], true);
    EXPECT_EQ(readRunFolder(job_.out_folder, "").sensor_label, "REAR");
}

TEST_F(RunWithTwoCameras, anExtendedMapKnowsTheCameraOfEachSession) {
    job_.sensor_label = "REAR";
    runSlamJob(job_);
    job_.map_folder = job_.out_folder;
    job_.map_use = MapUse::Extend;
    job_.out_folder = folder_ / "extended";
    runSlamJob(job_);
    const MapInputs inputs = readRunFolder(job_.out_folder, "");
    ASSERT_EQ(inputs.earlier.size(), 1u);
    EXPECT_EQ(inputs.earlier[0].sensor_label, "REAR");
    EXPECT_EQ(inputs.earlier[0].rawlog, job_.rawlog);
    EXPECT_EQ(inputs.sensor_label, "REAR");
}

TEST_F(RunWithTwoCameras, oneThatIsNotThereIsRefusedWithThoseThatAre) {
    job_.sensor_label = "TOP";
    const std::string problem = problemOf([&] { runSlamJob(job_); });
    EXPECT_THAT(problem, HasSubstr("no RGB-D camera 'TOP'"));
    EXPECT_THAT(problem, HasSubstr("'REAR' (CObservation3DRangeScan, 15)"));
}

TEST_F(RunChecks, aFinishedRunIsNotResumed) {
    write(filmRoundTrip(frames, turn_rad));
    runSlamJob(job_);
    EXPECT_THAT(problemOf([&] { resumedJob(job_.out_folder); }),
                HasSubstr("already complete (no checkpoint); nothing to resume"));
}

TEST_F(RunChecks, wrongDepthScaleReachesTheWarnings) {
    const Film film = enlarged(1.1F);
    write([&](RawlogWriter& writer) {
        for (int i = 0; i < frames; ++i) {
            mrpt::obs::CObservationRobotPose truth;
            truth.sensorLabel = ground_truth_label;
            truth.timestamp = film[i]->timestamp;
            truth.pose.mean = toCPose3D(roundTrip(i, turn_rad));
            writer.write(truth);
            writer.write(*film[i]);
        }
    });
    const JobReport report = runSlamJob(job_);
    EXPECT_THAT(report.warnings, Contains(HasSubstr("depth scale looks")));
    EXPECT_THAT(report.warnings, Contains(HasSubstr("too large")));
}

TEST_F(RunChecks, qualityIsToldWithoutTruth) {
    write(filmRoundTrip(frames, turn_rad));
    const JobReport report = runSlamJob(job_);
    const auto quality = summary()["quality"];
    EXPECT_EQ(quality["frames"]["tracked"], 1.0);
    EXPECT_GT(quality["inliers"]["median"], 50);
    EXPECT_GT(quality["depth_coverage"]["median"], 0.9);
    EXPECT_LT(quality["surface_spread"]["median_mm"], 5);
    EXPECT_TRUE(quality["loop_residuals"].is_null());
    EXPECT_THAT(resultTable(job_, report), HasSubstr("quality       surfaces agree within "));
}

KeyframeView keyframeAt(int id, double x) {
    KeyframeView keyframe;
    keyframe.id = id;
    keyframe.T_world_cam.t.x() = x;
    return keyframe;
}

TEST(Quality, loopsAreComparedWithTheFinishedMap) {
    PoseEdge loop;
    loop.from = 0;
    loop.to = 2;
    loop.T_from_to = SE3(rotationExp({0, 0, 0.01}), {2, 0, 0});
    const std::vector<KeyframeView> keyframes{keyframeAt(0, 0), keyframeAt(1, 1),
                                              keyframeAt(2, 2.03)};
    const auto residuals = loopResiduals({loop}, keyframes);
    ASSERT_TRUE(residuals);
    EXPECT_NEAR(residuals->median_m, 0.03, 1e-9);
    EXPECT_NEAR(residuals->max_deg, 0.01 * 180 / M_PI, 1e-9);
    EXPECT_FALSE(loopResiduals({}, keyframes));
}

TEST(Quality, driftIsTheGapThatALoopClosedAndItsShareOfTheWay) {
    Trajectory before_loops;
    std::vector<Keyframe> keyframes(5);
    for (int i = 0; i < 5; ++i) before_loops.push_back({i * 1., keyframeAt(i, i).T_world_cam});
    PoseEdge loop;
    loop.from = 0;
    loop.to = 4;
    loop.T_from_to.t.x() = 3.8;
    const auto drift = driftBeforeLoops({loop}, before_loops, keyframes);
    ASSERT_TRUE(drift);
    EXPECT_NEAR(drift->gap_m, 0.2, 1e-9);
    EXPECT_NEAR(drift->share(), 0.05, 1e-9);
    keyframes[2].link = Link::None;  // nobody saw how the camera came here
    EXPECT_FALSE(driftBeforeLoops({loop}, before_loops, keyframes));
}

}  // namespace
}  // namespace rgbd_graphslam
