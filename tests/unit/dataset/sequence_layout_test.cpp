#include "rgbd_graphslam/dataset/sequence_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using small_sequence::color;
using small_sequence::depth;
using ::testing::HasSubstr;

constexpr int frames = 3;
constexpr double rate_hz = 25;

/** Camera to world: a turn about y and a place, of frame i. */
SE3 poseOf(int i) {
    return {rotationExp({0, 0.1 * i, 0}), {0.1 * i, 0.2, -0.3}};
}

std::string matrixText(const SE3& T) {
    std::ostringstream text;
    text.precision(12);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) text << T.R(row, column) << "\t ";
        text << T.t[row] << "\n";
    }
    text << "0 0 0 1\n";
    return text.str();
}

std::string padded(int i) {
    char text[16];
    std::snprintf(text, sizeof text, "%06d", i);
    return text;
}

class Layout : public ::testing::Test {
  protected:
    void write(const std::string& name, const cv::Mat& image) const {
        const fs::path path = folder_ / ("s/" + name);
        fs::create_directories(path.parent_path());
        cv::imwrite(path.string(), image);
    }
    void writeText(const std::string& name, const std::string& text) const {
        folder_.write("s/" + name, text);
    }

    RgbdSequence readDetected(SequenceLayout expected) const {
        EXPECT_EQ(detectLayout(source()), expected);
        return readSequence(source(), detectLayout(source()), rate_hz);
    }

    /** Imports the sequence and compares what the rawlog then holds with what was written. */
    void expectImported(const RgbdSequence& sequence, CameraSetup setup,
                        const std::function<cv::Mat(int)>& expected_depth = depth) const {
        setup.camera.width = small_sequence::width;
        setup.camera.height = small_sequence::height;
        const auto report = importSequence(sequence, setup, folder_ / "s.rawlog", {});
        EXPECT_EQ(report.frames, static_cast<std::size_t>(frames));
        RawlogReader reader(folder_ / "s.rawlog");
        int i = 0;
        while (const auto observation = reader.next()) {
            const auto frame =
                std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
            if (!frame) continue;
            const RgbdImage image = toRgbdImage(frame);
            EXPECT_EQ(cv::norm(image.color, color(i), cv::NORM_L1), 0);
            EXPECT_EQ(cv::norm(image.depth, expected_depth(i), cv::NORM_L1), 0);
            EXPECT_NEAR(image.stamp_s, sequence.color[i].stamp_s, 1e-6);
            ++i;
        }
        EXPECT_EQ(i, frames);
    }

    void expectTruth(const Trajectory& truth) const {
        ASSERT_EQ(truth.size(), static_cast<std::size_t>(frames));
        for (int i = 0; i < frames; ++i) {
            EXPECT_LT(truth[i].T_world_cam.minus(poseOf(i)).norm(), 1e-6);
            EXPECT_NEAR(truth[i].stamp_s, i / rate_hz, 1e-9);
        }
    }

    std::string source() const { return folder_ / "s"; }
    TestFolder folder_;
};

TEST_F(Layout, tum) {
    small_sequence::make(folder_, "s", frames);
    const auto sequence = readDetected(SequenceLayout::Tum);
    EXPECT_FALSE(layoutCamera(sequence, SequenceLayout::Tum));
    expectImported(sequence, *cameraByName("ros"));
}

TEST_F(Layout, iclNuimIsMirroredToACameraWithYDown) {
    std::string associations, truth;
    for (int i = 0; i < frames; ++i) {
        const std::string n = std::to_string(i);
        write("rgb/" + n + ".png", color(i));
        write("depth/" + n + ".png", depth(i));
        associations += n + " depth/" + n + ".png " + n + " rgb/" + n + ".png\n";
        // The same pose seen by a camera with y up in a world with y up.
        const SE3 T = poseOf(i);
        const Eigen::Quaterniond q = T.quaternion();
        char line[256];
        std::snprintf(line, sizeof line, "%d %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", i, T.t.x(),
                      -T.t.y(), T.t.z(), -q.x(), q.y(), -q.z(), q.w());
        truth += line;
    }
    writeText("associations.txt", associations);
    writeText("livingRoom0.gt.freiburg", truth);
    const auto sequence = readDetected(SequenceLayout::Icl);
    expectTruth(sequence.truth);
    const auto camera = layoutCamera(sequence, SequenceLayout::Icl);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->camera.fy, 480);
    EXPECT_EQ(camera->depth_units, 5000);
    expectImported(sequence, *camera);
}

TEST_F(Layout, sevenScenesLosesItsMarkOfNoReading) {
    for (int i = 0; i < frames; ++i) {
        const std::string name = "frame-" + padded(i);
        write(name + ".color.png", color(i));
        write(name + ".depth.png", depth(i));
        writeText(name + ".pose.txt", matrixText(poseOf(i)));
    }
    const auto sequence = readDetected(SequenceLayout::SevenScenes);
    expectTruth(sequence.truth);
    const auto camera = layoutCamera(sequence, SequenceLayout::SevenScenes);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->depth_units, 1000);
    expectImported(sequence, *camera, [](int i) {
        cv::Mat without_mark = depth(i);
        without_mark.setTo(0, without_mark == 65535);
        return without_mark;
    });
}

TEST_F(Layout, bonnIsKnownByItsName) {
    small_sequence::make(folder_, "rgbd_bonn_balloon", frames);
    const std::string source = folder_ / "rgbd_bonn_balloon";
    EXPECT_EQ(detectLayout(source), SequenceLayout::Bonn);
    const auto sequence = readSequence(source, SequenceLayout::Bonn, rate_hz);
    const auto camera = layoutCamera(sequence, SequenceLayout::Bonn);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->camera.fx, 542.822841);
    EXPECT_TRUE(camera->camera.hasDistortion());
    expectImported(sequence, *camera);
}

TEST_F(Layout, eth3dBringsItsCalibration) {
    small_sequence::make(folder_, "s", frames);
    writeText("calibration.txt", "726.28 726.28 354.64 186.46\n");
    const auto sequence = readDetected(SequenceLayout::Eth3d);
    const auto camera = layoutCamera(sequence, SequenceLayout::Eth3d);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->camera.cx, 354.64);
    EXPECT_EQ(camera->camera.width, small_sequence::width);
    EXPECT_EQ(camera->camera.height, small_sequence::height);
    expectImported(sequence, *camera);
    writeText("calibration.txt", "726.28 0 354.64 186.46\n");
    EXPECT_THROW(layoutCamera(sequence, SequenceLayout::Eth3d), Error);
}

TEST_F(Layout, realSenseFoldersAndOpen3dsCalibration) {
    for (int i = 0; i < frames; ++i) {
        write("color/" + padded(i) + ".png", color(i));
        write("depth/" + padded(i) + ".png", depth(i));
        writeText("poses/" + padded(i) + ".txt", matrixText(poseOf(i)));
    }
    writeText("poses/" + padded(frames) + ".txt",
              "-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
              "-inf -inf -inf -inf\n0 0 0 1\n");
    auto sequence = readDetected(SequenceLayout::RealSense);
    expectTruth(sequence.truth);
    EXPECT_FALSE(layoutCamera(sequence, SequenceLayout::RealSense));
    writeText("camera_intrinsic.json",
              R"({"width": 32, "height": 24,
                  "intrinsic_matrix": [30.5, 0, 0, 0, 31.5, 0, 15.5, 11.5, 1]})");
    const auto camera = layoutCamera(sequence, SequenceLayout::RealSense);
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->camera.fx, 30.5);
    EXPECT_EQ(camera->camera.fy, 31.5);
    EXPECT_EQ(camera->camera.cx, 15.5);
    EXPECT_EQ(camera->camera.cy, 11.5);
    EXPECT_EQ(camera->depth_units, 1000);
    expectImported(sequence, *camera);
    writeText("camera_intrinsic.json", R"({"width": 32})");
    EXPECT_THROW(layoutCamera(sequence, SequenceLayout::RealSense), Error);
}

TEST_F(Layout, namesThatAreStampsKeepThem) {
    for (int i = 0; i < frames; ++i) {
        const std::string stamp = small_sequence::stampText(small_sequence::colorStamp(i));
        write("color/" + stamp + ".png", color(i));
        write("depth/" + stamp + ".png", depth(i));
    }
    const auto sequence = readDetected(SequenceLayout::RealSense);
    EXPECT_NEAR(sequence.color.at(2).stamp_s, small_sequence::colorStamp(2), 1e-6);
    expectImported(sequence, *cameraByName("ros"));
}

std::string complaint(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST_F(Layout, mistakesAreNamed) {
    writeText("readme.md", "nothing");
    const auto read = [&](SequenceLayout layout) {
        return complaint([&] { readSequence(source(), layout, rate_hz); });
    };
    EXPECT_THAT(complaint([&] { detectLayout(source()); }), HasSubstr("has no rgb.txt"));
    EXPECT_THAT(read(SequenceLayout::Icl), HasSubstr("is not laid out as --layout icl"));
    EXPECT_THAT(complaint([] { layoutByName("kitti"); }), HasSubstr("no layout 'kitti'"));
    writeText("associations.txt", "0 depth/0.png 0\n");
    EXPECT_THAT(read(SequenceLayout::Icl), HasSubstr("associations.txt:1: too few values"));
    fs::remove(folder_ / "s/associations.txt");
    writeText("frame-000000.depth.png", "");
    writeText("frame-000000.pose.txt", "1 0 0 0\n");
    EXPECT_THAT(read(SequenceLayout::SevenScenes), HasSubstr("is not a 4x4 matrix"));
    writeText("frame-000000.pose.txt", "2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n");
    EXPECT_THAT(read(SequenceLayout::SevenScenes), HasSubstr("is not a pose"));
    fs::remove_all(folder_ / "s");
    writeText("color/a.png", "");
    writeText("depth/a.png", "");
    EXPECT_EQ(detectLayout(source()), SequenceLayout::RealSense);
    EXPECT_THAT(read(SequenceLayout::RealSense), HasSubstr("has no number"));
}

}  // namespace
}  // namespace rgbd_graphslam
