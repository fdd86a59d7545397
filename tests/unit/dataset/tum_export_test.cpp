/** Whatever a rawlog holds, the folder that is written can be imported again. */
#include "rgbd_graphslam/dataset/tum_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <limits>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class TumExport : public ::testing::Test {
  protected:
    void SetUp() override { setVerbosity(Verbosity::Quiet); }

    /** Frame i of a camera with distortion, 1.5 m ahead of the robot, depth in mm. */
    mrpt::obs::CObservation3DRangeScan::Ptr frame(int i, const std::string& label,
                                                  int size_factor = 1) const {
        CameraSetup setup;
        setup.camera =
            Intrinsics{32, 24, 30, 31, 15.5, 11.5, BrownLens{{0.1, -0.2, 0.001, -0.002, 0.05}}};
        setup.depth_units = 1000;
        setup.T_base_sensor.t = {label == "left" ? 1.5 : -1.5, 0, 0.5};
        setup.camera = scaledUp(setup.camera, size_factor);
        auto observation = makeRgbdObservation(setup, small_sequence::colorStamp(i));
        observation->sensorLabel = label;
        setColor(*observation, small_sequence::color(i));
        setDepth(*observation, small_sequence::depth(i));
        return observation;
    }

    /** The calibration of images so many times as large. */
    static Intrinsics scaledUp(Intrinsics camera, int factor) {
        camera.width *= factor;
        camera.height *= factor;
        camera.fx *= factor;
        camera.fy *= factor;
        camera.cx = factor * (camera.cx + 0.5) - 0.5;
        camera.cy = factor * (camera.cy + 0.5) - 0.5;
        return camera;
    }

    std::vector<ExportReport> exported(const std::vector<CObservation::Ptr>& observations,
                                       const ExportOptions& options = {}) const {
        writeRawlog(folder_ / "a.rawlog", RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (const auto& observation : observations) writer.write(*observation);
        });
        return exportTumSequence(folder_ / "a.rawlog", folder_ / "out", options);
    }

    RawlogInfo importedAgain(const std::string& subfolder = "",
                             double max_difference_s = 0.02) const {
        const std::string sequence = (fs::path(folder_ / "out") / subfolder).string();
        ImportOptions options;
        options.max_difference_s = max_difference_s;
        importSequence(readTumSequence(sequence), readCameraFile(sequence + "/camera.ini"),
                       folder_ / "again.rawlog", options);
        return inspectRawlog(folder_ / "again.rawlog");
    }

    TestFolder folder_;
};

TEST_F(TumExport, framesWithoutTimestampsAreNamedByNumber) {
    std::vector<CObservation::Ptr> frames;
    for (int i = 0; i < 5; ++i) {
        frames.push_back(frame(i, "left"));
        frames.back()->timestamp = INVALID_TIMESTAMP;
    }
    ExportOptions options;
    options.rate_hz = 10;
    const auto reports = exported(frames, options);
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_EQ(reports[0].frames, 5u);
    EXPECT_THAT(reports[0].notes, ElementsAre(HasSubstr("no frame has a timestamp")));
    const RawlogInfo info = importedAgain();
    EXPECT_EQ(info.rgbd_frames, 5u);
    EXPECT_NEAR(info.last_stamp_s, 0.4, 1e-6);
    EXPECT_EQ(lensCoefficients(info.camera.lens)[1], -0.2);
    EXPECT_EQ(static_cast<float>(info.depth_unit_m), 1 / 1000.f);
    EXPECT_EQ(info.imu, 0u);
}

TEST_F(TumExport, someFramesWithoutTimestampsAreLeftOut) {
    std::vector<CObservation::Ptr> frames = {frame(0, "left"), frame(1, "left"), frame(2, "left")};
    frames[1]->timestamp = INVALID_TIMESTAMP;
    frames[2]->timestamp = frames[0]->timestamp;
    const auto reports = exported(frames);
    EXPECT_THAT(reports.at(0).notes,
                ElementsAre("1 frames left out: without a timestamp",
                            "1 frames left out: with the timestamp of an earlier one"));
    EXPECT_EQ(importedAgain().rgbd_frames, 1u);
}

TEST_F(TumExport, eachCameraGetsAFolder) {
    std::vector<CObservation::Ptr> log;
    for (int i = 0; i < 4; ++i) {
        auto pose = mrpt::obs::CObservationRobotPose::Create();
        pose->sensorLabel = ground_truth_label;
        pose->timestamp = toMrptTime(small_sequence::colorStamp(i));
        pose->pose.mean.x(i);
        log.push_back(pose);
        log.push_back(frame(i, "left"));
        if (i % 2 == 0) log.push_back(frame(i, "../right"));
    }
    const auto reports = exported(log);
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0].subfolder, "left");
    EXPECT_EQ(reports[1].subfolder, "___right");
    EXPECT_EQ(reports[1].camera, "../right");
    EXPECT_EQ(importedAgain("left").rgbd_frames, 4u);
    EXPECT_NEAR(truthOf(folder_ / "again.rawlog").at(3).T_world_cam.t.x(), 4.5, 1e-9);
    EXPECT_EQ(importedAgain("___right").rgbd_frames, 2u);
    EXPECT_NEAR(truthOf(folder_ / "again.rawlog").at(3).T_world_cam.t.x(), 1.5, 1e-9);
}

TEST_F(TumExport, oneCameraOfSeveral) {
    ExportOptions options;
    options.sensor_label = "right";
    const auto reports = exported({frame(0, "left"), frame(1, "right")}, options);
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_EQ(reports[0].subfolder, "");
    EXPECT_EQ(importedAgain().rgbd_frames, 1u);
    fs::remove_all(folder_ / "out");
    options.sensor_label = "middle";
    EXPECT_THAT(problemOf([&] {
                    exported({frame(0, "left"), frame(1, "right")}, options);
                }),
                HasSubstr("labelled 'middle'; the rawlog has 'left', 'right'"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(TumExport, readingsThatNoReaderTakesAreLeftOut) {
    const auto time = toMrptTime(small_sequence::colorStamp(0));
    const auto imu = [&](double value, const std::string& label) {
        auto reading = mrpt::obs::CObservationIMU::Create();
        reading->sensorLabel = label;
        reading->timestamp = time;
        for (const auto axis : {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_Z_ACC}) {
            reading->set(axis, value);
        }
        return reading;
    };
    auto unstamped = mrpt::obs::CObservationOdometry::Create();
    unstamped->timestamp = INVALID_TIMESTAMP;
    auto truth = mrpt::obs::CObservationRobotPose::Create();
    truth->sensorLabel = ground_truth_label;
    truth->timestamp = time;
    truth->pose.mean.y(nan);
    const auto reports = exported({imu(nan, "a"), imu(9, "a"), imu(8, "b"), unstamped, truth,
                                   mrpt::obs::CObservationIMU::Create(), frame(0, "left")});
    EXPECT_EQ(reports.at(0).imu, 1u);
    EXPECT_THAT(reports.at(0).notes, Contains(HasSubstr("3 readings of motion sensors left out")));
    EXPECT_THAT(reports.at(0).notes, Contains(HasSubstr("1 readings of 'b' left out")));
    const RawlogInfo info = importedAgain();
    EXPECT_EQ(info.imu, 1u);
    EXPECT_EQ(info.odometry + info.robot_poses, 0u);
}

TEST_F(TumExport, calibrationForLargerImagesIsScaled) {
    const auto reports = exported({frame(0, "left", 2)});
    EXPECT_THAT(reports.at(0).notes, ElementsAre(HasSubstr("it was scaled")));
    const RawlogInfo info = importedAgain();
    EXPECT_EQ(info.camera.width, 32);
    EXPECT_NEAR(info.camera.fx, 30, 1e-9);
    EXPECT_NEAR(info.camera.cx, 15.5, 1e-9);
}

TEST_F(TumExport, whatCannotBeASequenceIsRefused) {
    auto smaller = frame(1, "left");
    setColor(*smaller, cv::Mat(12, 16, CV_8UC3, cv::Scalar::all(9)));
    setDepth(*smaller, cv::Mat(12, 16, CV_16UC1, cv::Scalar(1000)));
    EXPECT_THAT(problemOf([&] {
                    exported({frame(0, "left"), smaller});
                }),
                HasSubstr("has 16x12 pixels, the first one 32x24"));
    auto odd = frame(0, "left");
    odd->cameraParamsIntensity.ncols = 40;
    EXPECT_THAT(problemOf([&] { exported({odd}); }),
                HasSubstr("calibration is for 40x24 pixels, the images have 32x24"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(TumExport, depthFarInTimeIsToldWithTheOptionThatPairsIt) {
    small_sequence::make(folder_, "s", 3);
    ImportOptions wide;
    wide.max_difference_s = 0.1;
    RgbdSequence sequence = readTumSequence(folder_ / "s");
    for (auto& image : sequence.depth) image.stamp_s += 0.05;
    importSequence(sequence, readCameraFile(folder_ / "s/camera.ini"), folder_ / "b.rawlog", wide);
    const auto reports = exportTumSequence(folder_ / "b.rawlog", folder_ / "out", {});
    ASSERT_THAT(reports.at(0).notes, Contains(HasSubstr("import with --max-difference 0.0")));
    EXPECT_EQ(importedAgain("", 0.06).rgbd_frames, reports[0].frames);
}

}  // namespace
}  // namespace rgbd_graphslam
