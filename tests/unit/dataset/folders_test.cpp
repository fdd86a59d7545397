/** Folders without lists, phones' folders and ScanNet's files. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "../../support/problem_of.h"
#include "../../support/small_sens.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/foreign_file.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/unpacked_sens.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using small_sequence::color;
using small_sequence::depth;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr int frames = 4;

class Folders : public ::testing::Test {
  protected:
    void SetUp() override { setVerbosity(Verbosity::Quiet); }

    void image(const std::string& name, const cv::Mat& pixels) const {
        const fs::path path = folder_ / ("s/" + name);
        fs::create_directories(path.parent_path());
        ASSERT_TRUE(cv::imwrite(path.string(), pixels)) << name;
    }

    RgbdSequence read(SequenceLayout expected) const {
        EXPECT_EQ(detectLayout(source()), expected);
        return readSequence(source(), detectLayout(source()), 25);
    }

    std::vector<RgbdImage> imported(const RgbdSequence& sequence, const CameraSetup& setup) const {
        ImportOptions options;
        options.depth_camera = sequence.depth_camera;
        importSequence(sequence, setup, folder_ / "s.rawlog", options);
        std::vector<RgbdImage> images;
        RawlogReader reader(folder_ / "s.rawlog");
        while (const auto observation = reader.next()) {
            const auto frame =
                std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
            if (frame) images.push_back(toRgbdImage(frame));
        }
        return images;
    }

    static CameraSetup smallCamera() {
        CameraSetup setup;
        setup.camera = Intrinsics{32, 24, 30, 31, 15.5, 11.5, {}};
        return setup;
    }

    std::string source() const { return folder_ / "s"; }
    TestFolder folder_;
};

TEST_F(Folders, namesThatAreStampsInAnyUnit) {
    const std::vector<std::pair<double, std::string>> units = {{1.0, "stamps in seconds"},
                                                               {1e-3, "stamps in milliseconds"},
                                                               {1e-6, "stamps in microseconds"},
                                                               {1e-9, "stamps in nanoseconds"}};
    for (const auto& [unit_s, said] : units) {
        fs::remove_all(source());
        for (int i = 0; i < frames; ++i) {
            char name[64];
            std::snprintf(name, sizeof name, "%.*f", unit_s == 1 ? 6 : 0,
                          small_sequence::colorStamp(i) / unit_s);
            image("rgb/" + std::string(name) + ".jpg", color(i));
            image("depth/" + std::string(name) + ".PNG", depth(i));
        }
        const RgbdSequence sequence = read(SequenceLayout::Folders);
        EXPECT_THAT(sequence.notes, Contains(HasSubstr(said)));
        EXPECT_NEAR(sequence.color.at(2).stamp_s, small_sequence::colorStamp(2), 1e-3);
        EXPECT_EQ(imported(sequence, smallCamera()).size(), std::size_t(frames));
    }
}

TEST_F(Folders, numbersAndEveryImageFormat) {
    const char* color_ending[] = {".png", ".webp", ".ppm", ".bmp"};
    const char* depth_ending[] = {".png", ".tiff", ".pgm", ".tif"};
    for (int i = 0; i < frames; ++i) {
        image("image/frame_" + std::to_string(7 * i) + color_ending[i], color(i));
        image("depth/" + std::to_string(7 * i) + depth_ending[i], depth(i));
    }
    const RgbdSequence sequence = read(SequenceLayout::Folders);
    EXPECT_THAT(sequence.notes, Contains(HasSubstr("numbered")));
    EXPECT_NEAR(sequence.color.at(1).stamp_s, 7 / 25.0, 1e-9);
    const auto images = imported(sequence, smallCamera());
    ASSERT_EQ(images.size(), std::size_t(frames));
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(cv::norm(images[i].depth, depth(i), cv::NORM_L1), 0) << depth_ending[i];
    }
}

TEST_F(Folders, depthInMetersIsConverted) {
    cv::Mat1f meters(24, 32, 1.25f);
    meters(0, 0) = std::numeric_limits<float>::quiet_NaN();
    meters(0, 1) = -1;
    meters(0, 2) = 100;
    image("rgb/000000.png", color(0));
    image("depth/000000.tiff", meters);
    const auto images = imported(read(SequenceLayout::Folders), smallCamera());
    ASSERT_EQ(images.size(), 1u);
    EXPECT_EQ(images[0].depth.at<std::uint16_t>(1, 1), 6250) << "5000 units per meter";
    for (int u = 0; u < 3; ++u) EXPECT_EQ(images[0].depth.at<std::uint16_t>(0, u), 0) << u;
}

TEST_F(Folders, calibrationOfTheFolder) {
    image("rgb/000000.png", color(0));
    image("depth/000000.png", depth(0));
    folder_.write("s/intrinsics.json", R"({"fx": 30, "fy": 31, "cx": 15.5, "cy": 11.5})");
    const RgbdSequence sequence = read(SequenceLayout::Folders);
    const auto camera = layoutCamera(sequence, SequenceLayout::Folders);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->camera.width, 32) << "of the images";
    EXPECT_EQ(imported(sequence, *camera).size(), 1u);
}

TEST_F(Folders, aPrincipalPointOutsideTheImageIsRefused) {
    image("rgb/000000.png", color(0));
    image("depth/000000.png", depth(0));
    folder_.write("s/intrinsics.json", R"({"fx": 30, "fy": 31, "cx": 40, "cy": 11.5})");
    const RgbdSequence sequence = read(SequenceLayout::Folders);
    EXPECT_THAT(problemOf([&] { layoutCamera(sequence, SequenceLayout::Folders); }),
                HasSubstr("intrinsics.json': the principal point (cx 40, cy 11.5) is outside"));
}

TEST_F(Folders, emptyFoldersAndNamesWithoutNumbers) {
    fs::create_directories(folder_ / "s/rgb");
    fs::create_directories(folder_ / "s/depth");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::Folders); }), HasSubstr("rgb' has no image"));
    folder_.write("s/rgb/a.png", "");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::Folders); }), HasSubstr("has no number"));
}

class Phone : public Folders {
  protected:
    /** Color of 32x24, depth of half the size; frame 2 has no pose. */
    void writeStray() const {
        std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
        for (int i = 0; i < frames; ++i) {
            const std::string name = "00000" + std::to_string(i) + ".png";
            image("rgb/" + name, color(i));
            image("depth/" + name, cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000 + i)));
            cv::Mat confidence(24, 32, CV_8UC1, cv::Scalar(2));
            confidence.row(0) = 0;
            confidence.row(1) = 1;
            image("confidence/" + name, confidence);
            if (i == 2) continue;
            odometry += std::to_string(5000.5 + 0.016 * i) + ", 00000" + std::to_string(i) +
                        ", 0, 0, 0, 0, 0, 0, 1\n";
        }
        folder_.write("s/odometry.csv", odometry);
        folder_.write("s/camera_matrix.csv", "30.0, 0, 15.5\n0, 31.0, 11.5\n0, 0, 1\n");
        folder_.write("s/imu.csv", "timestamp, a_x, a_y, a_z, alpha_x, alpha_y, alpha_z\n");
    }
};

TEST_F(Phone, strayScanner) {
    writeStray();
    const RgbdSequence sequence = read(SequenceLayout::StrayScanner);
    EXPECT_EQ(sequence.color.size(), 3u);
    EXPECT_NEAR(sequence.color.at(1).stamp_s, 5000.516, 1e-9);
    EXPECT_TRUE(sequence.truth.empty());
    EXPECT_THAT(sequence.notes, Contains(HasSubstr("not taken as ground truth")));
    ASSERT_TRUE(sequence.camera);
    EXPECT_EQ(sequence.camera->camera.fy, 31);
    const auto images = imported(sequence, *sequence.camera);
    ASSERT_EQ(images.size(), 3u);
    EXPECT_EQ(images[1].depth.at<std::uint16_t>(0, 5), 0) << "no confidence";
    EXPECT_EQ(images[1].depth.at<std::uint16_t>(1, 5), 1001) << "medium confidence";
    EXPECT_NEAR(images[1].depth_unit_m, 0.001, 1e-9);
}

/** On its side, so that images are upright, its right side up; turning to the left. */
TEST_F(Phone, strayScannersImu) {
    for (const double unit : {1.0, 9.80665}) {
        writeStray();
        folder_.write("s/imu.csv", "timestamp, a_x, a_y, a_z, alpha_x, alpha_y, alpha_z\n5000.5, " +
                                       std::to_string(-unit) + ", 0, 0, 0.25, 0, 0\n");
        const RgbdSequence sequence = read(SequenceLayout::StrayScanner);
        ASSERT_EQ(sequence.acceleration.size(), 1u);
        const Eigen::Matrix3d& R_camera_imu = sequence.camera->T_sensor_imu.R;
        const Eigen::Vector3d felt = R_camera_imu * sequence.acceleration[0].value,
                              turn = R_camera_imu * sequence.angular_velocity[0].value;
        EXPECT_LT((felt - Eigen::Vector3d(0, 0, 9.80665)).norm(), 1e-4);
        EXPECT_LT((turn - Eigen::Vector3d(0, 0, 0.25)).norm(), 1e-9);
        EXPECT_NEAR(sequence.angular_velocity[0].stamp_s, 5000.5, 1e-9);
        EXPECT_THAT(sequence.notes, Contains(HasSubstr(unit == 1 ? "in g" : "in m/s2")));
    }
}

TEST_F(Phone, strayScannersVideoAndDamage) {
    writeStray();
    fs::remove(folder_ / "s/confidence/000001.png");
    EXPECT_THAT(problemOf([&] {
                    const RgbdSequence sequence = read(SequenceLayout::StrayScanner);
                    imported(sequence, *sequence.camera);
                }),
                HasSubstr("confidence/000001.png' is missing"));
    folder_.write("s/camera_matrix.csv", "30.0, 0, 15.5\n");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::StrayScanner); }), HasSubstr("is not a 3x3 matrix"));
    folder_.write("s/odometry.csv", "timestamp, frame\n1.0, x\n");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::StrayScanner); }),
                HasSubstr("odometry.csv:2: 'x' is not a number"));
    fs::remove_all(folder_ / "s/rgb");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::StrayScanner); }),
                HasSubstr("ffmpeg -i rgb.mp4"));
}

TEST_F(Phone, record3d) {
    for (int i = 0; i < frames; ++i) {
        image("rgb/" + std::to_string(i) + ".jpg", color(i));
        image("depth/" + std::to_string(i) + ".png", depth(i));
    }
    folder_.write("s/metadata",
                  R"({"w": 64, "h": 48, "fps": 60, "K": [61, 0, 0, 0, 62, 0, 31.5, 23.5, 1]})");
    const RgbdSequence sequence = read(SequenceLayout::Record3d);
    ASSERT_TRUE(sequence.camera);
    EXPECT_EQ(sequence.camera->camera.fx, 30.5) << "images are half as large as the metadata says";
    EXPECT_EQ(sequence.camera->camera.cx, 15.5);
    EXPECT_NEAR(sequence.color.at(3).stamp_s, 0.05, 1e-9);
    EXPECT_EQ(imported(sequence, *sequence.camera).size(), std::size_t(frames));
    folder_.write("s/metadata", R"({"w": 64, "K": "none"})");
    EXPECT_THAT(problemOf([&] { read(SequenceLayout::Record3d); }), HasSubstr("has no K of 9"));
}

class Sens : public Folders {
  protected:
    static std::string sens(std::uint64_t stamp_step_us, float depth_fx = 30) {
        SmallSens made;
        for (int i = 0; i < frames; ++i) made.frames.push_back({color(i), depth(i)});
        made.stamp_step_us = stamp_step_us;
        made.depth_fx = depth_fx;
        return made.bytes();
    }

    std::string file() const { return folder_ / "a.sens"; }
};

TEST_F(Sens, isUnpackedWithPosesAndCalibration) {
    folder_.write("a.sens", sens(33333));
    ASSERT_TRUE(isSens(file()));
    const UnpackedSens unpacked(file(), folder_ / "", 30);
    const RgbdSequence& sequence = unpacked.sequence();
    ASSERT_TRUE(sequence.camera);
    EXPECT_FALSE(sequence.depth_camera) << "one calibration for both";
    EXPECT_NEAR(sequence.color.at(1).stamp_s, 0.03334, 1e-9);
    ASSERT_EQ(sequence.truth.size(), 3u);
    EXPECT_NEAR(sequence.truth[1].T_world_cam.t.x(), 1, 1e-6);
    EXPECT_EQ(sequence.truth[1].stamp_s, sequence.color[2].stamp_s);
    const auto images = imported(sequence, *sequence.camera);
    ASSERT_EQ(images.size(), std::size_t(frames));
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(cv::norm(images[i].color, color(i), cv::NORM_L1), 0);
        EXPECT_EQ(cv::norm(images[i].depth, depth(i), cv::NORM_L1), 0);
    }
}

TEST_F(Sens, withoutTimestampsAndWithTwoCalibrations) {
    folder_.write("a.sens", sens(0, 20));
    const UnpackedSens unpacked(file(), folder_ / "", 20);
    EXPECT_THAT(unpacked.sequence().notes, Contains(HasSubstr("no timestamps")));
    EXPECT_NEAR(unpacked.sequence().color.at(2).stamp_s, 0.1, 1e-9);
    ASSERT_TRUE(unpacked.sequence().depth_camera);
    EXPECT_EQ(unpacked.sequence().depth_camera->camera.fx, 20);
}

TEST_F(Sens, cutOrDamagedAnywhere) {
    const std::string whole = sens(33333);
    const auto problem = [&](const std::string& bytes) {
        folder_.write("a.sens", bytes);
        return problemOf([&] { UnpackedSens(file(), folder_ / "", 30); });
    };
    for (int percent = 0; percent < 100; percent += 7) {
        EXPECT_THAT(problem(whole.substr(0, whole.size() * percent / 100)), HasSubstr("a.sens' "))
            << percent;
    }
    const std::size_t header = 4 + 8 + 4 + 4 * 64;
    EXPECT_THAT(problem("\5" + whole.substr(1)), HasSubstr("version 4"));
    std::string huge = whole;
    huge.replace(header + 8, 4, "\xff\xff\xff\x7f");
    EXPECT_THAT(problem(huge), HasSubstr("impossible size"));
    std::string sizes = whole;
    sizes.replace(header + 8 + 16 + 4 + 8 + 64 + 16, 8, std::string(8, '\x7f'));
    EXPECT_THAT(problem(sizes), HasSubstr("damaged at frame 0"));
    std::string count = whole;
    count.replace(header + 8 + 16 + 4, 8, std::string(8, '\x7f'));
    EXPECT_THAT(problem(count), HasSubstr("cut off"));
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
        EXPECT_EQ(entry.path().filename(), "a.sens") << "nothing is left behind";
    }
}

TEST_F(Folders, filesOfOtherKindsAreNamed) {
    const auto problem = [&](const std::string& name, const std::string& bytes) {
        folder_.write(name, bytes);
        return problemOf([&] { refuseForeignFile(folder_ / name); });
    };
    EXPECT_THAT(problem("a.mkv", "\x1a\x45\xdf\xa3 rest"), HasSubstr("azure_kinect_mkv_reader"));
    EXPECT_THAT(problem("a.oni", std::string("ONI\0rest", 8)), HasSubstr("OpenNI"));
    EXPECT_THAT(problem("a.klg", "any"), HasSubstr("klg2png"));
    EXPECT_THAT(problem("a.h5", "\x89HDF\r\n\x1a\n"), HasSubstr("HDF5"));
    EXPECT_THAT(problem("a.mp4", std::string("\0\0\0\x18"
                                             "ftypmp42",
                                             12)),
                HasSubstr("ffmpeg"));
    EXPECT_THAT(problem("a.txt", "hello"), HasSubstr("not a folder"));
    EXPECT_THAT(problem("b", ""), HasSubstr("is empty"));
}

TEST_F(Folders, aFolderTooHighIsToldWhereTheSequenceIs) {
    small_sequence::make(folder_, "s/below", 1);
    EXPECT_THAT(problemOf([&] { detectLayout(source()); }), HasSubstr("did you mean"));
}

}  // namespace
}  // namespace rgbd_graphslam
