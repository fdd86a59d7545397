/** What is written to rawlogs comes back, and MRPT understands it. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdlib>
#include <filesystem>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/depth_registration.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_export.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using ::testing::HasSubstr;

bool samePixels(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

std::vector<mrpt::obs::CObservation::Ptr> readAll(const std::string& path) {
    std::vector<mrpt::obs::CObservation::Ptr> all;
    RawlogReader reader(path);
    while (const auto observation = reader.next()) all.push_back(observation);
    return all;
}

std::vector<CObservation3DRangeScan::Ptr> framesOf(const std::string& path) {
    std::vector<CObservation3DRangeScan::Ptr> frames;
    for (const auto& observation : readAll(path)) {
        const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
        if (frame) frames.push_back(frame);
    }
    return frames;
}

constexpr int frame_count = 4;

class RawlogTest : public ::testing::Test {
  protected:
    void SetUp() override {
        setVerbosity(Verbosity::Quiet);
        small_sequence::make(folder_, "s", frame_count);
        folder_.write("s/groundtruth.txt",
                      "1305031453.3 1 2 3 0 0 0 1\n1305031453.4 1.5 2 3 0.5 0.5 0.5 0.5\n");
        folder_.write("s/accelerometer.txt",
                      "1305031453.35 0.1 9.8 0.2\n1305031453.36 0.3 9.7 -1e-7\n");
        folder_.write("s/gyroscope.txt", "1305031453.36 0.01 0.02 0.03\n1305031453.37 0 1 2\n");
        folder_.write("s/odometry.txt", "1305031453.38 0.5 -0.25 3\n");
    }

    ImportReport import(RawlogStorage storage = RawlogStorage::Embedded) {
        ImportOptions options;
        options.storage = storage;
        return importSequence(readTumSequence(folder_ / "s"),
                              readCameraFile(folder_ / "s/camera.ini"), rawlog(), options);
    }

    std::string rawlog() const { return folder_ / "s.rawlog"; }

    TestFolder folder_;
};

class RawlogStorageTest : public RawlogTest, public ::testing::WithParamInterface<RawlogStorage> {};

TEST_P(RawlogStorageTest, imagesKeepTheirBits) {
    import(GetParam());
    const auto frames = framesOf(rawlog());
    ASSERT_EQ(frames.size(), frame_count);
    for (int i = 0; i < frame_count; ++i) {
        const RgbdImage image = toRgbdImage(frames[i]);
        EXPECT_TRUE(samePixels(image.color, small_sequence::color(i))) << i;
        EXPECT_TRUE(samePixels(image.depth, small_sequence::depth(i))) << i;
        EXPECT_EQ(image.gray.type(), CV_8UC1);
        EXPECT_NEAR(image.stamp_s, small_sequence::colorStamp(i), 0.5e-6);
        EXPECT_EQ(static_cast<float>(image.depth_unit_m), 1 / 5000.f);
    }
}

TEST_P(RawlogStorageTest, exportGivesTheFolderBack) {
    import(GetParam());
    exportTumSequence(rawlog(), folder_ / "back", {});
    const RgbdSequence before = readTumSequence(folder_ / "s");
    const RgbdSequence after = readTumSequence(folder_ / "back");
    ASSERT_EQ(after.color.size(), before.color.size());
    ASSERT_EQ(after.depth.size(), before.depth.size());
    for (int i = 0; i < frame_count; ++i) {
        EXPECT_EQ(after.color[i].stamp_s, before.color[i].stamp_s);
        EXPECT_EQ(after.depth[i].stamp_s, before.depth[i].stamp_s);
        const std::string color = folder_ / ("back/" + after.color[i].file);
        const std::string depth = folder_ / ("back/" + after.depth[i].file);
        EXPECT_TRUE(samePixels(cv::imread(color), small_sequence::color(i)));
        EXPECT_TRUE(samePixels(cv::imread(depth, cv::IMREAD_UNCHANGED), small_sequence::depth(i)));
    }
}

INSTANTIATE_TEST_SUITE_P(Both, RawlogStorageTest,
                         ::testing::Values(RawlogStorage::Embedded, RawlogStorage::Compact));

/** How far colors are off on average, gray levels. */
double meanDifference(const cv::Mat& a, const cv::Mat& b) {
    return cv::norm(a, b, cv::NORM_L1) / (3.0 * a.total());
}

TEST_F(RawlogTest, smallStorageLosesLittleColorAndNothingElse) {
    const cv::Mat smooth(small_sequence::height, small_sequence::width, CV_8UC3, {40, 150, 90});
    for (int i = 0; i < frame_count; ++i)
        cv::imwrite(folder_ / ("s/" + small_sequence::colorFile(i)), smooth);
    import();
    const auto embedded_bytes = std::filesystem::file_size(rawlog());
    import(RawlogStorage::Small);
    EXPECT_LT(std::filesystem::file_size(rawlog()), 0.8 * embedded_bytes);
    const auto frames = framesOf(rawlog());
    ASSERT_EQ(frames.size(), frame_count);
    for (int i = 0; i < frame_count; ++i) {
        const RgbdImage image = toRgbdImage(frames[i]);
        EXPECT_TRUE(samePixels(image.depth, small_sequence::depth(i))) << i;
        EXPECT_LT(meanDifference(image.color, smooth), 3) << i;
        EXPECT_NEAR(image.stamp_s, small_sequence::colorStamp(i), 0.5e-6);
    }
}

TEST_F(RawlogTest, sharedPixelsOutliveTheObservation) {
    import();
    RgbdImage image = toRgbdImage(framesOf(rawlog()).front());
    EXPECT_TRUE(samePixels(image.depth, small_sequence::depth(0)));
    EXPECT_TRUE(samePixels(image.color, small_sequence::color(0)));
}

TEST_F(RawlogTest, entriesAreInOrderOfTimeOverAllSensors) {
    import();
    const auto all = readAll(rawlog());
    EXPECT_EQ(all.size(), 1u + frame_count + 2 + 3 + 1);
    for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_LE(all[i - 1]->timestamp, all[i]->timestamp) << i;
    }
}

TEST_F(RawlogTest, calibrationAndPlaceOfTheSensorAreKept) {
    import();
    const auto frame = framesOf(rawlog()).front();
    EXPECT_EQ(cameraOf(*frame).fy, 31);
    EXPECT_EQ(lensCoefficients(cameraOf(*frame).lens)[1], -0.2);
    EXPECT_TRUE(frame->cameraParams == frame->cameraParamsIntensity);
    EXPECT_TRUE(frame->doDepthAndIntensityCamerasCoincide());
    EXPECT_NEAR(frame->sensorPose.z(), 0.6, 1e-12);
    EXPECT_NEAR(frame->sensorPose.pitch(), mrpt::DEG2RAD(10.0), 1e-12);
    const SE3 T_base_cam = cameraOnRobot(*frame);
    const Eigen::Vector3d optical_axis = T_base_cam.R.col(2);
    EXPECT_NEAR(optical_axis.z(), -std::sin(mrpt::DEG2RAD(10.0)), 1e-9) << "looks down";
    EXPECT_GT(optical_axis.x(), 0.9) << "looks forward";
}

TEST_F(RawlogTest, mrptProjectsDepthToTheSamePlaces) {
    folder_.write("s/camera.ini",
                  "[CAMERA_PARAMS]\nresolution = [32 24]\nfx = 30\nfy = 31\ncx = 15.5\ncy = 11.5\n"
                  "sensor_pose = [0.1 0 0.6 0 10 0]\n");
    import();
    const auto frame = framesOf(rawlog()).front();
    const CameraModel camera = cameraOf(*frame);
    const SE3 T_base_cam = cameraOnRobot(*frame);
    mrpt::obs::T3DPointsProjectionParams parameters;
    parameters.takeIntoAccountSensorPoseOnRobot = true;
    frame->unprojectInto(*frame, parameters);
    ASSERT_GT(frame->points3D_x.size(), 700u);
    for (std::size_t k = 0; k < frame->points3D_x.size(); ++k) {
        const int u = frame->points3D_idxs_x[k], v = frame->points3D_idxs_y[k];
        const double z = small_sequence::depth(0).at<std::uint16_t>(v, u) / 5000.0;
        const Eigen::Vector3d expected = T_base_cam * camera.unproject(u, v, z);
        const Eigen::Vector3d actual(frame->points3D_x[k], frame->points3D_y[k],
                                     frame->points3D_z[k]);
        ASSERT_LT((actual - expected).norm(), 1e-4) << u << " " << v;
    }
}

TEST_F(RawlogTest, truthIsThatOfTheCameraAgain) {
    import();
    const Trajectory expected = readTumSequence(folder_ / "s").truth, truth = truthOf(rawlog());
    ASSERT_EQ(truth.size(), expected.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_EQ(truth[i].stamp_s, expected[i].stamp_s);
        EXPECT_LT((truth[i].T_world_cam.t - expected[i].T_world_cam.t).norm(), 1e-9);
        EXPECT_LT((truth[i].T_world_cam.R - expected[i].T_world_cam.R).norm(), 1e-9);
    }
}

TEST_F(RawlogTest, motionSensorsKeepTheirReadings) {
    import();
    exportTumSequence(rawlog(), folder_ / "back", {});
    const RgbdSequence before = readTumSequence(folder_ / "s");
    const RgbdSequence after = readTumSequence(folder_ / "back");
    const auto expectSame = [](const auto& a, const auto& b) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].stamp_s, b[i].stamp_s);
            EXPECT_EQ(a[i].value, b[i].value);
        }
    };
    expectSame(after.acceleration, before.acceleration);
    expectSame(after.angular_velocity, before.angular_velocity);
    expectSame(after.odometry, before.odometry);
    EXPECT_EQ(readText(folder_ / "back/camera.ini"),
              toIniText(readCameraFile(folder_ / "back/camera.ini")));
}

TEST_F(RawlogTest, readingsOfOneImuAtOneStampShareAnObservation) {
    import();
    std::vector<mrpt::obs::CObservationIMU::Ptr> readings;
    for (const auto& observation : readAll(rawlog())) {
        const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(observation);
        if (imu) readings.push_back(imu);
    }
    ASSERT_EQ(readings.size(), 3u);
    EXPECT_FALSE(readings[0]->has(mrpt::obs::IMU_WX));
    EXPECT_EQ(readings[1]->get(mrpt::obs::IMU_Z_ACC), -1e-7);
    EXPECT_EQ(readings[1]->get(mrpt::obs::IMU_WZ), 0.03);
    EXPECT_FALSE(readings[2]->has(mrpt::obs::IMU_X_ACC));
    // At rest and level the accelerometer's y axis feels +g; that axis is up on the robot's sensor.
    const Eigen::Vector3d up = toSE3(readings[0]->sensorPose).R.col(1);
    EXPECT_NEAR(up.z(), std::cos(mrpt::DEG2RAD(10.0)), 1e-9);
}

TEST_F(RawlogTest, fragmentsAreCutByTimeAndThinned) {
    import();
    ExportOptions options;
    options.from_s = 0.02;
    options.to_s = 0.11;
    options.every = 2;
    EXPECT_EQ(exportTumSequence(rawlog(), folder_ / "part", options).at(0).frames, 2u);
    const RgbdSequence part = readTumSequence(folder_ / "part");
    EXPECT_EQ(part.color.at(0).file, small_sequence::colorFile(1));
    EXPECT_EQ(part.color.at(1).file, small_sequence::colorFile(3));
    EXPECT_TRUE(part.acceleration.empty()) << "all before the first frame";
}

TEST_F(RawlogTest, inspectionCountsAndDescribes) {
    import();
    const RawlogInfo info = inspectRawlog(rawlog());
    EXPECT_EQ(info.rgbd_frames, frame_count);
    EXPECT_EQ(info.imu, 3u);
    EXPECT_EQ(info.odometry, 1u);
    EXPECT_EQ(info.robot_poses, 2u);
    EXPECT_NEAR(info.first_stamp_s, small_sequence::colorStamp(0), 0.5e-6);
    EXPECT_NEAR(info.last_stamp_s, small_sequence::colorStamp(3), 0.5e-6);
    EXPECT_EQ(info.camera.width, small_sequence::width);
    EXPECT_TRUE(info.depth_is_registered);
    EXPECT_EQ(info.damage, "");
}

TEST_F(RawlogTest, mrptsOwnReaderTakesIt) {
    import();
    mrpt::obs::CRawlog whole;
    ASSERT_TRUE(whole.loadFromRawLogFile(rawlog()));
    EXPECT_EQ(whole.size(), std::size_t(frame_count) + 2 + 3 + 1);
    EXPECT_THAT(whole.getCommentText(), HasSubstr("\n1305031453.359684 = 1305031453.365184\n"));
}

/** Unsynchronized stamps and odd trailing digits as a real camera gives them. */
TEST(RawlogOfRealFrames, roundTripKeepsEveryBit) {
    const char* data = std::getenv("RGBD_DATA");
    const std::string clip =
        std::string(data ? data : RGBD_SOURCE_DIR "/../shared/data") + "/tum-fr1-xyz-4";
    if (!std::filesystem::exists(clip)) GTEST_SKIP() << "no data in " << clip;
    setVerbosity(Verbosity::Quiet);
    const TestFolder folder;
    const RgbdSequence before = readTumSequence(clip);
    importSequence(before, *cameraByFolderName(clip), folder / "c.rawlog", {});
    exportTumSequence(folder / "c.rawlog", folder / "back", {});
    const RgbdSequence after = readTumSequence(folder / "back");
    ASSERT_EQ(after.depth.size(), 3u) << "one depth image is missing in the source";
    for (std::size_t i = 0; i < after.depth.size(); ++i) {
        EXPECT_EQ(after.depth[i].file, before.depth[i].file);
        for (const std::string& file : {after.depth[i].file, after.color[i].file}) {
            EXPECT_TRUE(samePixels(cv::imread(folder / ("back/" + file), cv::IMREAD_UNCHANGED),
                                   cv::imread(clip + "/" + file, cv::IMREAD_UNCHANGED)))
                << file;
        }
    }
    ASSERT_EQ(after.acceleration.size(), before.acceleration.size());
    for (std::size_t i = 0; i < after.acceleration.size(); ++i) {
        EXPECT_EQ(after.acceleration[i].stamp_s, before.acceleration[i].stamp_s);
        EXPECT_EQ(after.acceleration[i].value, before.acceleration[i].value);
    }
    ASSERT_EQ(after.truth.size(), before.truth.size());
    for (std::size_t i = 0; i < after.truth.size(); ++i) {
        EXPECT_EQ(after.truth[i].stamp_s, before.truth[i].stamp_s);
        EXPECT_EQ(after.truth[i].T_world_cam.t, before.truth[i].T_world_cam.t);
    }
}

/** A depth camera with other pixels, turned a little against the color camera. */
CameraSetup depthCamera() {
    CameraSetup setup;
    setup.camera = Intrinsics{24, 18, 22, 22, 11.5, 8.5, {}};
    setup.depth_units = 1000;
    setup.T_base_sensor = {rotationExp({0.05, 0.02, 0}), {0.1, 0.03, 0.6}};
    return setup;
}

TEST_F(RawlogTest, depthOfAnotherCameraIsWarpedToColor) {
    small_sequence::make(folder_, "s", 2);
    const CameraSetup color_camera = readCameraFile(folder_ / "s/camera.ini");
    const CameraSetup depth_camera = depthCamera();
    const cv::Mat seen(18, 24, CV_16UC1, cv::Scalar(2000));
    for (int i = 0; i < 2; ++i) cv::imwrite(folder_ / ("s/" + small_sequence::depthFile(i)), seen);
    ImportOptions options;
    options.depth_camera = depth_camera;
    importSequence(readTumSequence(folder_ / "s"), color_camera, folder_ / "s.rawlog", options);
    const SE3 T_color_depth = T_optical_from_mrpt * color_camera.T_base_sensor.inverse() *
                              depth_camera.T_base_sensor * T_optical_from_mrpt.inverse();
    const cv::Mat expected =
        DepthRegistration(depth_camera.camera, color_camera.camera, T_color_depth, 0.001)(seen);
    RawlogReader reader(folder_ / "s.rawlog");
    int frames = 0;
    while (const auto observation = reader.next()) {
        const auto frame =
            std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
        if (!frame) continue;
        const RgbdImage image = toRgbdImage(frame);
        EXPECT_EQ(cv::norm(image.depth, expected, cv::NORM_INF), 0);
        EXPECT_FLOAT_EQ(image.depth_unit_m, 0.001);
        EXPECT_GT(cv::countNonZero(image.depth), 100);
        ++frames;
    }
    EXPECT_EQ(frames, 2);
}

TEST_F(RawlogTest, importIsTheSameWithAnyNumberOfThreads) {
    const RgbdSequence sequence = readTumSequence(folder_ / "s");
    const CameraSetup setup = readCameraFile(folder_ / "s/camera.ini");
    ImportOptions options;
    for (const int threads : {1, 4}) {
        options.threads = threads;
        importSequence(sequence, setup, folder_ / (std::to_string(threads) + ".rawlog"), options);
    }
    EXPECT_EQ(readText(folder_ / "1.rawlog"), readText(folder_ / "4.rawlog"));
}

TEST_F(RawlogTest, leftOverImagesAreCountedByReason) {
    folder_.write("s/rgb.txt",
                  "1.00 rgb/a.png\n1.00 rgb/b.png\n1.01 rgb/b.png\n5 rgb/a.png\n2 rgb/gone.png\n"
                  "0.5 rgb/a.png\n");
    folder_.write("s/depth.txt", "1.012 depth/a.png\n5.001 depth/a.png\n9 depth/a.png\n");
    cv::imwrite(folder_ / "s/rgb/a.png", small_sequence::color(0));
    cv::imwrite(folder_ / "s/rgb/b.png", small_sequence::color(1));
    cv::imwrite(folder_ / "s/depth/a.png", small_sequence::depth(0));
    const ImportReport report = import();
    EXPECT_EQ(report.frames, 2u);
    EXPECT_EQ(report.color.listed, 6u);
    EXPECT_EQ(report.color.repeated, 1u);
    EXPECT_EQ(report.color.missing, 1u);
    EXPECT_EQ(report.color.partner_taken, 1u) << "1.00, its depth belongs to 1.01";
    EXPECT_EQ(report.color.no_partner, 1u) << "0.5";
    EXPECT_EQ(report.color.backwards, 2u);
    EXPECT_EQ(report.depth.no_partner, 1u) << "9";
    EXPECT_NEAR(report.longest_gap_s, 3.99, 1e-6) << "1.01 to 5";
    EXPECT_THAT(toText(report), ::testing::HasSubstr("longest gap 3.99 s"));
    EXPECT_TRUE(samePixels(toRgbdImage(framesOf(rawlog())[0]).color, small_sequence::color(1)));
}

TEST_F(RawlogTest, lensesAreThoseOfTheRawlog) {
    import();
    const auto frame = framesOf(rawlog()).front();
    const auto model = [&] { return lensModel(cameraOf(*frame).lens); };
    frame->cameraParamsIntensity.setDistortionKannalaBrandt(0.1, 0.02, 0, 0);
    EXPECT_EQ(model(), "kannala_brandt");
    frame->cameraParamsIntensity.setDistortionPlumbBob(0.1, 0, 0, 0, 0);
    EXPECT_EQ(model(), "plumb_bob");
    frame->cameraParamsIntensity.dist[5] = 0.3;
    EXPECT_EQ(model(), "rational");
    frame->cameraParamsIntensity.setDistortionKannalaBrandt(-4, 0, 0, 0);
    EXPECT_THAT(problemOf(model), HasSubstr("cannot be undone"));
}

TEST_F(RawlogTest, framesWithoutDepthOrColorOrOfUnequalSizeAreNamed) {
    const auto complaint = [](const CObservation3DRangeScan::Ptr& frame) -> std::string {
        try {
            toRgbdImage(frame);
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    };
    const auto frame = makeRgbdObservation({}, 12.25);
    EXPECT_THAT(complaint(frame), HasSubstr("stamp 12.250000: no color"));
    setColor(*frame, small_sequence::color(0));
    EXPECT_THAT(complaint(frame), HasSubstr("no depth"));
    setDepth(*frame, cv::Mat::zeros(5, 5, CV_16UC1));
    EXPECT_THAT(complaint(frame), HasSubstr("differ in size"));
    setDepth(*frame, small_sequence::depth(0));
    EXPECT_EQ(complaint(frame), "no error");
}

TEST_F(RawlogTest, cutFilesGiveWhatIsWholeAndThenSayWhere) {
    import();
    cutFile(rawlog(), 0.6);
    RawlogReader reader(rawlog());
    int frames = 0;
    std::string complaint;
    try {
        while (const auto observation = reader.next()) {
            frames += IS_CLASS(*observation, CObservation3DRangeScan);
        }
    } catch (const Error& e) {
        complaint = e.what();
    }
    EXPECT_EQ(frames, 2);
    EXPECT_THAT(complaint, HasSubstr("entry"));
    EXPECT_THAT(complaint, HasSubstr("byte"));
    EXPECT_EQ(complaint.find('\n'), std::string::npos);
    EXPECT_EQ(inspectRawlog(rawlog()).rgbd_frames, 2u);
    EXPECT_EQ(inspectRawlog(rawlog()).damage, complaint);
}

TEST(RawlogReader, compressedFilesAndSensoryFramesAreHandedOutOneByOne) {
    const TestFolder folder;
    const std::string path = folder / "f.rawlog.gz";
    {
        mrpt::io::CFileGZOutputStream out(path);
        mrpt::obs::CSensoryFrame sensory_frame;
        for (int i = 0; i < 2000; ++i) {
            auto odometry = mrpt::obs::CObservationOdometry::Create();
            odometry->odometry = {i * 0.1, i * i * 0.3, i * 0.01};
            sensory_frame.insert(odometry);
        }
        mrpt::serialization::archiveFrom(out) << sensory_frame << sensory_frame;
    }
    RawlogReader reader(path);
    int count = 0;
    while (reader.next()) ++count;
    EXPECT_EQ(count, 4000);
    EXPECT_EQ(reader.progress(), 1.0);

    cutFile(path, 0.9);
    EXPECT_FALSE(inspectRawlog(path).damage.empty());
}

TEST(RawlogReader, whatIsNoRawlogIsRefused) {
    const TestFolder folder;
    folder.write("text.rawlog", "This is a text of some length, not a rawlog at all.\n");
    folder.write("empty.rawlog", "");
    for (const std::string name : {"text.rawlog", "empty.rawlog", "missing.rawlog", ""}) {
        EXPECT_THROW(RawlogReader reader(folder / name), Error) << name;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
