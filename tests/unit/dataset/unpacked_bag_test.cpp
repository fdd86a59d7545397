/** Bags written by ROS's own Python library and by npm's MCAP writer, read by ours. */
#include "rgbd_graphslam/dataset/unpacked_bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "../../support/bag_lines.h"
#include "../../support/problem_of.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using small_sequence::colorStamp;
using small_sequence::depthStamp;
using small_sequence::stampText;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int frames = 4;
const std::string camera_frame = "/openni_rgb_optical_frame";

/** Depth in meters as the benchmark's bags have it, without reading where the PNG has 0. */
cv::Mat inMetres(const cv::Mat& depth) {
    cv::Mat1f meters;
    depth.convertTo(meters, CV_32F, 1.0 / 5000);
    meters.setTo(std::numeric_limits<float>::quiet_NaN(), depth == 0);
    return meters;
}

cv::Mat inRgb(const cv::Mat& color) {
    cv::Mat rgb;
    cv::cvtColor(color, rgb, cv::COLOR_BGR2RGB);
    return rgb;
}

cv::Mat millimeters(int value) {
    return {24, 32, CV_16UC1, cv::Scalar(value)};
}

/** Of the camera's mount in the world; exact in few digits. */
std::string mountPose(int i) {
    return std::to_string(i) + " 0.5 1.25 0 0 0.6 0.8";
}

class Bag : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!canWriteRos1Bags()) GTEST_SKIP() << ros1_needs;
    }

    std::string bag() const { return folder_ / "rgbd.bag"; }

    /** The small sequence with accelerometer and truth: its folder, and the lines of its bag. */
    void makeSequence() {
        small_sequence::make(folder_, "f/rgbd", frames);
        folder_.write("f/rgbd/camera.ini",
                      "[CAMERA_PARAMS]\nresolution = [32 24]\nfx = 30\nfy = 31\ncx = 15.5\n"
                      "cy = 11.5\ndist = [0.1 -0.2 0.001 -0.002 0.05]\n");
        std::string acceleration;
        for (int i = 0; i < frames; ++i) {
            const std::string stamp = stampText(colorStamp(i));
            acceleration += stamp + " 0.25 " + std::to_string(i) + " -9.5\n";
            lines_.add("camera_info /camera/rgb/camera_info " + camera_frame + " " + stamp +
                       " 32 24 30 31 15.5 11.5 0.1 -0.2 0.001 -0.002 0.05");
            lines_.addImage("/camera/rgb/image_color", camera_frame, colorStamp(i), "rgb8",
                            inRgb(small_sequence::color(i)));
            lines_.addImage("/camera/depth/image", camera_frame, depthStamp(i), "32FC1",
                            inMetres(small_sequence::depth(i)));
            lines_.addImage("/other/image", camera_frame, depthStamp(i), "rgb8",
                            small_sequence::color(9));
            lines_.add("imu /imu " + stamp + " 0.25 " + std::to_string(i) + " -9.5");
            lines_.add("tf /tf " + stamp + " /world /kinect " + mountPose(i));
            lines_.add("tf /tf " + stamp + " /kinect " + camera_frame + " 0.1 0 0 0 0 0 1");
        }
        folder_.write("f/rgbd/accelerometer.txt", acceleration);
    }

    /** One frame of color and registered depth. */
    void addFrame(double stamp_s) {
        lines_.addImage("/camera/color/image_raw", "color", stamp_s, "bgr8",
                        small_sequence::color(0));
        lines_.addImage("/camera/depth/image_raw", "color", stamp_s, "16UC1", millimeters(1500));
    }

    RgbdSequence read(const BagOptions& options = {}) {
        lines_.recordRos1(bag());
        return UnpackedBag(bag(), folder_ / "", options).sequence();
    }

    std::string complaint(const std::string& file) const {
        return problemOf([&] { UnpackedBag(file, folder_ / ""); });
    }
    std::string complaint() const { return complaint(bag()); }

    /** The rawlog without what the bag has as numbers and the folder as text. */
    std::string rawlogOf(RgbdSequence sequence, const CameraSetup& setup) const {
        sequence.truth.clear();
        importSequence(sequence, setup, folder_ / "rgbd.rawlog", {});
        return readText(folder_ / "rgbd.rawlog");
    }

    void expectTheSequence(const std::string& file, const std::string& expected) const {
        const UnpackedBag unpacked(file, folder_ / "");
        const RgbdSequence& sequence = unpacked.sequence();
        ASSERT_TRUE(sequence.camera) << file;
        EXPECT_FALSE(sequence.depth_camera) << file;
        CameraSetup setup = *sequence.camera;
        setup.name = "camera.ini";
        EXPECT_TRUE(rawlogOf(sequence, setup) == expected) << file;
        ASSERT_EQ(sequence.truth.size(), frames) << file;
        for (int i = 0; i < frames; ++i) {
            // The camera is 0.1 m before its mount, which is turned by 2 acos(0.8) about z.
            const Eigen::Vector3d place(i + 0.028, 0.596, 1.25);
            EXPECT_LT((sequence.truth[i].T_world_cam.t - place).norm(), 1e-9) << file;
            EXPECT_NEAR(sequence.truth[i].stamp_s, colorStamp(i), 1e-6) << file;
        }
    }

    TestFolder folder_;
    BagLines lines_;
};

TEST_F(Bag, givesTheSameRawlogAsTheFolder) {
    makeSequence();
    const std::string expected = rawlogOf(readTumSequence(folder_ / "f/rgbd"),
                                          readCameraFile(folder_ / "f/rgbd/camera.ini"));
    for (const char* compression : {"none", "bz2", "lz4"}) {
        lines_.recordRos1(bag(), compression);
        expectTheSequence(bag(), expected);
    }
}

TEST_F(Bag, ofRos2GivesTheSameRawlogAsTheFolder) {
    if (!canWriteRos2Bags()) GTEST_SKIP() << ros2_needs;
    makeSequence();
    const std::string expected = rawlogOf(readTumSequence(folder_ / "f/rgbd"),
                                          readCameraFile(folder_ / "f/rgbd/camera.ini"));
    for (const char* compression : {"none", "zstd", "lz4"}) {
        lines_.recordRos2(folder_ / "rgbd.mcap", compression);
        expectTheSequence(folder_ / "rgbd.mcap", expected);
    }
    for (const char* compression : {"none", "messages"}) {
        lines_.recordRos2(folder_ / "rgbd.db3", compression);
        expectTheSequence(folder_ / "rgbd.db3", expected);
    }
    ASSERT_EQ(std::system(("zstd -q --rm '" + folder_ / "rgbd.db3" + "' -o '" +
                           folder_ / "rgbd.db3.zstd" + "'")
                              .c_str()),
              0);
    expectTheSequence(folder_ / "rgbd.db3.zstd", expected);
}

TEST_F(Bag, partsOfARos2FolderFollowEachOther) {
    if (!canWriteRos2Bags()) GTEST_SKIP() << ros2_needs;
    fs::create_directories(folder_ / "drive");
    for (const int part : {10, 9, 2}) {
        lines_.clear();
        addFrame(part);
        lines_.recordRos2(folder_ / ("drive/drive_" + std::to_string(part) + ".db3"));
    }
    folder_.write("drive/metadata.yaml",
                  "rosbag2_bagfile_information:\n  relative_file_paths:\n    - drive_2.db3\n"
                  "    - drive_9.db3\n    - drive_10.db3\n  duration:\n");
    ASSERT_TRUE(isBag(folder_ / "drive"));
    const UnpackedBag unpacked(folder_ / "drive", folder_ / "");
    std::vector<double> stamps;
    for (const auto& image : unpacked.sequence().color) stamps.push_back(image.stamp_s);
    EXPECT_THAT(stamps, ElementsAre(2, 9, 10));
    fs::remove(folder_ / "drive/drive_9.db3");
    EXPECT_THAT(complaint(folder_ / "drive"), HasSubstr("drive_9.db3', which metadata.yaml lists"));
}

TEST_F(Bag, theTemporaryFolderGoes) {
    makeSequence();
    lines_.recordRos1(bag());
    std::string folder;
    {
        const UnpackedBag unpacked(bag(), folder_ / "");
        folder = unpacked.sequence().folder;
        EXPECT_TRUE(fs::exists(folder + "/rgb"));
        EXPECT_TRUE(unpacked.sequence().angular_velocity.empty()) << "its covariance says so";
    }
    EXPECT_FALSE(fs::exists(fs::path(folder).parent_path()));
}

TEST_F(Bag, millimetresKeepTheirValuesAndMetresThatAreFarFitIn) {
    addFrame(1.5);
    EXPECT_EQ(read().depth_units, 1000);
    lines_.clear();
    lines_.addImage("/c", "c", 1.5, "bgr8", small_sequence::color(0));
    lines_.addImage("/d", "c", 1.5, "32FC1", cv::Mat(24, 32, CV_32FC1, cv::Scalar(20.5)));
    lines_.recordRos1(bag());
    const UnpackedBag unpacked(bag(), folder_ / "");
    EXPECT_EQ(unpacked.sequence().depth_units, 1000);
    const cv::Mat depth = cv::imread(
        unpacked.sequence().folder + "/" + unpacked.sequence().depth[0].file, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1);
    EXPECT_EQ(cv::norm(depth, millimeters(20500), cv::NORM_INF), 0);
}

TEST_F(Bag, compressedImagesKeepTheirBytes) {
    std::vector<unsigned char> jpeg, png;
    cv::imencode(".jpg", small_sequence::color(0), jpeg);
    cv::imencode(".png", millimeters(1500), png);
    const std::string settings(12, '\0');
    lines_.addCompressed("/c/image_raw/compressed", "c", 1, "rgb8;~jpeg~compressed~bgr8",
                         {jpeg.begin(), jpeg.end()});
    lines_.addCompressed("/d/image_raw/compressedDepth", "c", 1, "16UC1;~compressedDepth~png",
                         settings + std::string(png.begin(), png.end()));
    lines_.recordRos1(bag());
    const UnpackedBag unpacked(bag(), folder_ / "");
    const RgbdSequence& sequence = unpacked.sequence();
    EXPECT_EQ(readText(sequence.folder + "/" + sequence.color[0].file),
              std::string(jpeg.begin(), jpeg.end()));
    EXPECT_EQ(readText(sequence.folder + "/" + sequence.depth[0].file),
              std::string(png.begin(), png.end()));
    EXPECT_EQ(sequence.camera->camera.width, 32) << "read from the JPEG's header";
}

TEST_F(Bag, colorIsChosenBeforeInfraredAndAlignedDepthBeforeRaw) {
    for (const double stamp_s : {1.0, 2.0}) {
        lines_.addImage("/camera/infra1/image_rect_raw", "ir", stamp_s, "mono8",
                        cv::Mat(24, 32, CV_8UC1, cv::Scalar(7)));
        lines_.addImage("/camera/depth/image_rect_raw", "depth", stamp_s, "16UC1", millimeters(1));
        lines_.addImage("/camera/aligned_depth_to_color/image_raw", "color", stamp_s, "16UC1",
                        millimeters(2));
        lines_.addImage("/camera/color/image_raw", "color", stamp_s, "rgb8",
                        small_sequence::color(0));
    }
    const RgbdSequence sequence = read();
    EXPECT_THAT(sequence.notes, Contains(HasSubstr("color: /camera/color/image_raw, rgb8, 32x24, "
                                                   "2 images at 1.0 Hz")));
    EXPECT_THAT(sequence.notes,
                Contains(AllOf(HasSubstr("depth: /camera/aligned_depth_to_color/image_raw"),
                               HasSubstr("registered to color"))));
    EXPECT_THAT(sequence.notes,
                Contains(AllOf(HasSubstr("left out: "), HasSubstr("/camera/infra1/image_rect_raw"),
                               HasSubstr("/camera/depth/image_rect_raw"))));
    const RgbdSequence other =
        read({"/camera/infra1/image_rect_raw", "/camera/depth/image_rect_raw"});
    EXPECT_THAT(other.notes, Contains(HasSubstr("color: /camera/infra1")));
    EXPECT_THAT(other.notes, Contains(HasSubstr("depth: /camera/depth/image_rect_raw")));
    EXPECT_THAT(
        problemOf([&] {
            read({"/nothing", ""});
        }),
        AllOf(HasSubstr("no image topic '/nothing'"), HasSubstr("/camera/color/image_raw")));
}

/** A static transform is no ground truth, and neither is odometry. */
TEST_F(Bag, onlyAMovingFrameNamedSoIsTruth) {
    addFrame(1);
    EXPECT_TRUE(read().truth.empty()) << "without /tf";
    EXPECT_THAT(read().notes, Contains(HasSubstr("no ground truth")));
    lines_.add("tf /tf_static 1.0 world base_link 1 2 3 0 0 0 1");
    lines_.add("tf /tf_static 1.0 base_link color 0.2 0 0.5 0 0 0 1");
    EXPECT_TRUE(read().truth.empty()) << "static";
    lines_.clear();
    addFrame(1);
    for (int i = 0; i < 3; ++i) {
        lines_.add("tf /tf " + std::to_string(i) + ".5 odom base_link " + std::to_string(i) +
                   " 0.5 0 0 0 0.6 0.8");
    }
    lines_.add("tf /tf_static 1.0 base_link color 0.2 0 0.5 0 0 0 1");
    const RgbdSequence sequence = read();
    EXPECT_TRUE(sequence.truth.empty()) << "odom";
    ASSERT_EQ(sequence.odometry.size(), 3u);
    EXPECT_NEAR(sequence.odometry[2].stamp_s, 2.5, 1e-6);
    EXPECT_LT((sequence.odometry[2].value - Eigen::Vector3d(2, 0.5, 2 * std::asin(0.6))).norm(),
              1e-9);
}

TEST_F(Bag, staticTransformsTellWhereTheCameraSits) {
    addFrame(1);
    lines_.add("tf /tf_static 1.0 base_footprint base_link 0 0 0.1 0 0 0 1");
    lines_.add("tf /tf_static 1.0 base_link color 0.2 0 0.5 -0.5 0.5 -0.5 0.5");
    lines_.add("tf /tf_static 1.0 base_link laser 0.3 0 0 0 0 0 1");
    lines_.add("scan /scan laser 1.25 -1 0.5 0.1 9 1 2 3 99 0.05");
    lines_.add("fix /gps gps 1.25 0 47.5 8.25 400");
    lines_.add("odometry /odom odom 1.5 base_link 1 2 0.5");
    const RgbdSequence sequence = read();
    const SE3& T_base_sensor = sequence.camera->T_base_sensor;
    EXPECT_LT((T_base_sensor.t - Eigen::Vector3d(0.2, 0, 0.6)).norm(), 1e-9);
    EXPECT_LT(T_base_sensor.angle(), 1e-9) << "it looks forward";
    ASSERT_EQ(sequence.odometry.size(), 1u);
    EXPECT_LT((sequence.odometry[0].value - Eigen::Vector3d(1, 2, 0.5)).norm(), 1e-9);
    ASSERT_EQ(sequence.others.size(), 2u);
    const auto scan =
        std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(sequence.others[0]);
    ASSERT_TRUE(scan);
    EXPECT_NEAR(toSeconds(scan->timestamp), 1.25, 1e-6);
    EXPECT_NEAR(scan->sensorPose.x(), 0.3, 1e-6);
    EXPECT_NEAR(scan->sensorPose.z(), 0.1, 1e-6);
    EXPECT_NEAR(scan->aperture, 2, 1e-6);
    EXPECT_NEAR(scan->getScanRange(2), 3, 1e-6);
    EXPECT_TRUE(scan->getScanRangeValidity(2));
    EXPECT_FALSE(scan->getScanRangeValidity(3)) << "beyond range_max";
    EXPECT_FALSE(scan->getScanRangeValidity(4)) << "nearer than range_min";
    const auto fix = std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(sequence.others[1]);
    ASSERT_TRUE(fix);
    const auto& gga = fix->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
    EXPECT_EQ(gga.latitude_degrees, 47.5);
    EXPECT_EQ(gga.altitude_meters, 400);
    EXPECT_EQ(gga.fix_quality, 1);
}

/** RealSense's driver without unite_imu_method. */
TEST_F(Bag, accelerometerAndGyroscopeComeFromTwoTopics) {
    addFrame(1);
    lines_.add("tf /tf_static 1.0 camera_link color 0 0 0 0 0 0 1");
    lines_.add("tf /tf_static 1.0 camera_link camera_imu_optical_frame 0.5 0 0 0 0 0.6 0.8");
    for (const std::string stamp : {"1.1", "1.2", "1.3"}) {
        lines_.add("imu6 /camera/gyro/sample camera_imu_optical_frame " + stamp + " 0 0 0 1 2 3");
        lines_.add("imu6 /camera/accel/sample camera_imu_optical_frame " + stamp + " 4 5 6 0 0 0");
        lines_.add("imu6 /robot/imu imu " + stamp + " 9 9 9 9 9 9");
    }
    const RgbdSequence sequence = read();
    ASSERT_EQ(sequence.acceleration.size(), 3u);
    EXPECT_EQ(sequence.acceleration[0].value, Eigen::Vector3d(4, 5, 6));
    ASSERT_EQ(sequence.angular_velocity.size(), 3u);
    EXPECT_EQ(sequence.angular_velocity[0].value, Eigen::Vector3d(1, 2, 3));
    const SE3 T_color_imu = T_optical_from_mrpt * sequence.camera->T_sensor_imu;
    EXPECT_LT((T_color_imu.t - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-9);
    EXPECT_NEAR(T_color_imu.angle(), 2 * std::asin(0.6), 1e-9);
    EXPECT_THAT(sequence.notes, Contains(AllOf(HasSubstr("left out"), HasSubstr("/robot/imu"))));
}

class RawDepth : public Bag {
  protected:
    void addStreams(const std::string& color, const std::string& depth, const std::string& frame,
                    const std::string& encoding) {
        lines_.addImage(color, "color", 1, "rgb8", small_sequence::color(0));
        lines_.addImage(depth, frame, 1, encoding, millimeters(1500));
    }

    /** Where the depth camera lies in the color camera's optical frame. */
    static Eigen::Vector3d depthInColor(const RgbdSequence& sequence) {
        return (T_optical_from_mrpt * sequence.camera->T_base_sensor.inverse() *
                sequence.depth_camera->T_base_sensor * T_optical_from_mrpt.inverse())
            .t;
    }
};

TEST_F(RawDepth, isWarpedByBothCalibrationsAndTheStaticTransform) {
    addStreams("/camera/color/image_raw", "/camera/depth/image_rect_raw", "depth", "16UC1");
    EXPECT_FALSE(read().depth_camera);
    EXPECT_THAT(read().notes, Contains(HasSubstr("raw, and its calibration is not recorded")));
    lines_.add("camera_info /camera/color/camera_info color 1.0 32 24 30 30 16 12 0 0 0 0 0");
    lines_.add("camera_info /camera/depth/camera_info depth 1.0 32 24 20 20 16 12 0 0 0 0 0");
    EXPECT_THAT(read().notes, Contains(HasSubstr("the pose of its camera is not recorded")));
    lines_.add("extrinsics /camera/extrinsics/depth_to_color 1.0 0.25 0 0");
    RgbdSequence sequence = read();
    ASSERT_TRUE(sequence.depth_camera);
    EXPECT_EQ(sequence.depth_camera->camera.fx, 20);
    EXPECT_EQ(sequence.depth_camera->depth_units, 1000);
    EXPECT_LT((depthInColor(sequence) - Eigen::Vector3d(0.25, 0, 0)).norm(), 1e-9);
    lines_.add("tf /tf_static 1.0 base_link color 1 0 0 0 0 0.6 0.8");
    lines_.add("tf /tf_static 1.0 color depth 0.015 0 0 0 0 0 1");
    sequence = read();
    EXPECT_LT((depthInColor(sequence) - Eigen::Vector3d(0.015, 0, 0)).norm(), 1e-9);
}

/** Laid out as librealsense's ros_file_format.h says; no recording of it was at hand. */
TEST_F(RawDepth, ofLibrealsensesRecorderIsWarped) {
    const std::string color = "/device_0/sensor_1/Color_0", depth = "/device_0/sensor_0/Depth_0";
    addStreams(color + "/image/data", depth + "/image/data", "0", "mono16");
    lines_.addImage("/device_0/sensor_0/Infrared_1/image/data", "0", 1, "8UC1",
                    cv::Mat(24, 32, CV_8UC1, cv::Scalar(7)));
    lines_.add("camera_info " + color + "/info/camera_info 0 1.0 32 24 30 30 16 12 0 0 0 0 0");
    lines_.add("camera_info " + depth + "/info/camera_info 0 1.0 32 24 20 20 16 12 0 0 0 0 0");
    lines_.add("transform " + color + "/tf/0 1.0 0.015 0 0 0 0 0 1");
    lines_.add("transform " + depth + "/tf/0 1.0 0 0 0 0 0 0 1");
    lines_.add("number /device_0/sensor_0/option/Depth_Units/value 1.0 0.00025");
    lines_.add("imu6 /device_0/sensor_2/Accel_0/imu/data 0 1.1 0 -9.8 0 0 0 0");
    lines_.add("imu6 /device_0/sensor_2/Gyro_0/imu/data 0 1.1 0 0 0 0.1 0 0");
    lines_.add("transform /device_0/sensor_2/Accel_0/tf/0 1.0 0.1 0 0 0 0 0 1");
    const RgbdSequence sequence = read();
    EXPECT_NEAR(*sequence.depth_units, 4000, 1e-3);
    ASSERT_TRUE(sequence.depth_camera);
    EXPECT_EQ(sequence.depth_camera->camera.fx, 20);
    EXPECT_EQ(sequence.camera->camera.fx, 30);
    EXPECT_LT((depthInColor(sequence) - Eigen::Vector3d(0.015, 0, 0)).norm(), 1e-9);
    EXPECT_EQ(sequence.acceleration.size(), 1u);
    EXPECT_EQ(sequence.angular_velocity.size(), 1u);
    const SE3 T_color_imu = T_optical_from_mrpt * sequence.camera->T_sensor_imu;
    EXPECT_LT((T_color_imu.t - Eigen::Vector3d(0.015 - 0.1, 0, 0)).norm(), 1e-9);
}

TEST_F(RawDepth, withTheCalibrationOfColorIsRegistered) {
    addStreams("/camera/rgb/image_raw", "/camera/depth/image_raw", "color", "16UC1");
    lines_.add("camera_info /camera/rgb/camera_info color 1.0 32 24 30 30 16 12 0 0 0 0 0");
    lines_.add("camera_info /camera/depth/camera_info color 1.0 32 24 30 30 16 12 0 0 0 0 0");
    const RgbdSequence sequence = read();
    EXPECT_FALSE(sequence.depth_camera);
    EXPECT_THAT(sequence.notes, Contains(HasSubstr("registered to color")));
}

TEST_F(Bag, otherSensorsComeWithoutACamera) {
    lines_.add("imu6 /imu base_link 1.0 1 2 3 4 5 6");
    lines_.add("string /status 1.0 fine");
    lines_.recordRos1(bag());
    EXPECT_THAT(complaint(),
                AllOf(HasSubstr("holds no color images"), HasSubstr("/imu (sensor_msgs/Imu, 1)"),
                      HasSubstr("/status (std_msgs/String, 1)"), HasSubstr("--no-camera"),
                      Not(HasSubstr("\n"))));
    const RgbdSequence sequence = UnpackedBag(bag(), folder_ / "", {"", "", true}).sequence();
    EXPECT_EQ(sequence.acceleration.size(), 1u);
    EXPECT_LT(sequence.camera->T_sensor_imu.angle(), 1e-9);
}

TEST_F(Bag, whatLacksIsSaid) {
    lines_.addImage("/c", "c", 1, "bgr8", small_sequence::color(0));
    lines_.recordRos1(bag());
    EXPECT_THAT(complaint(), HasSubstr("holds no depth images"));
    lines_.clear();
    lines_.addImage("/c", "c", 1, "h264", small_sequence::color(0));
    lines_.recordRos1(bag());
    EXPECT_THAT(complaint(), HasSubstr("holds no color images"));
}

TEST_F(Bag, anImageThatLacksPixelsIsRefused) {
    addFrame(1);
    lines_.text().replace(lines_.text().find(" 32 24 "), 7, " 99 24 ");
    lines_.recordRos1(bag());
    EXPECT_THAT(complaint(), HasSubstr("image at 1.000000 is not whole"));
}

TEST_F(Bag, damageIsSaidAndNothingLeftBehind) {
    folder_.write("rgbd.bag", "no bag");
    EXPECT_THAT(complaint(), HasSubstr("is not a ROS 1 bag of format 2.0"));
    makeSequence();
    for (const char* compression : {"none", "bz2"}) {
        for (const double share : {0.3, 0.6, 0.9}) {
            lines_.recordRos1(bag(), compression);
            cutFile(bag(), share);
            EXPECT_THAT(complaint(), HasSubstr("is damaged or cut off")) << compression << share;
        }
    }
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
        EXPECT_NE(entry.path().filename().string().rfind(".tmp", 0), 0u) << entry;
    }
}

TEST_F(Bag, damageToRos2FilesIsSaid) {
    if (!canWriteRos2Bags()) GTEST_SKIP() << ros2_needs;
    makeSequence();
    folder_.write("a.mcap", "no bag");
    EXPECT_THAT(complaint(folder_ / "a.mcap"), HasSubstr("is not an MCAP file"));
    folder_.write("a.db3", "no bag");
    EXPECT_THAT(complaint(folder_ / "a.db3"), HasSubstr("is damaged or no ROS 2 bag"));
    // A view may go on for ever.
    const std::string views =
        "CREATE TABLE topics(id, name, type, serialization_format);"
        "CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL "
        "SELECT id + 1 FROM n) SELECT id, 1, 1, 1 FROM n;";
    const std::string make = "import sqlite3; sqlite3.connect('" + folder_ / "v.db3" +
                             "').executescript('" + views + "')";
    ASSERT_EQ(std::system(("/usr/bin/python3 -c \"" + make + "\"").c_str()), 0);
    EXPECT_THAT(complaint(folder_ / "v.db3"), HasSubstr("it lacks a table"));
    for (const char* compression : {"none", "zstd", "lz4"}) {
        lines_.recordRos2(folder_ / "a.mcap", compression);
        std::string bytes = readText(folder_ / "a.mcap");
        bytes[bytes.size() / 4] ^= 0x55;
        folder_.write("a.mcap", bytes);
        EXPECT_THAT(complaint(folder_ / "a.mcap"), HasSubstr("is damaged (")) << compression;
    }
    lines_.recordRos2(folder_ / "a.db3");
    cutFile(folder_ / "a.db3", 0.5);
    EXPECT_THAT(complaint(folder_ / "a.db3"), HasSubstr("is damaged or no ROS 2 bag"));
    lines_.recordRos2(folder_ / "b.db3");
    ASSERT_EQ(
        std::system(
            ("zstd -q '" + folder_ / "b.db3" + "' -o '" + folder_ / "b.db3.zstd" + "'").c_str()),
        0);
    cutFile(folder_ / "b.db3.zstd", 0.5);
    EXPECT_THAT(complaint(folder_ / "b.db3.zstd"), HasSubstr("is damaged or cut off"));
}

TEST_F(Bag, ofAKilledRecorderGivesWhatIsThere) {
    makeSequence();
    for (const char* compression : {"none", "lz4"}) {
        lines_.recordRos1(bag(), compression);
        unclose(bag(), compression == std::string("none") ? 0.8 : 1);
        const WarningRecord record;
        const UnpackedBag unpacked(bag(), folder_ / "");
        EXPECT_GE(unpacked.sequence().color.size(), 2u);
        EXPECT_THAT(record.warnings(), Contains(HasSubstr("is not whole (the recorder did not")));
    }
    if (!canWriteRos2Bags()) return;
    lines_.recordRos2(folder_ / "a.mcap", "zstd");
    cutFile(folder_ / "a.mcap", 0.8);
    const WarningRecord record;
    const UnpackedBag unpacked(folder_ / "a.mcap", folder_ / "");
    EXPECT_GE(unpacked.sequence().color.size(), 1u);
    EXPECT_THAT(record.warnings(), Contains(HasSubstr("the file has no end")));
}

}  // namespace
}  // namespace rgbd_graphslam
