/** What an import finds out about depth and calibration. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/depth_registration.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation3DRangeScan;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/** A folder in TUM's layout whose images a test makes. */
class ImportPlausibility : public ::testing::Test {
  protected:
    void SetUp() override {
        setVerbosity(Verbosity::Quiet);
        fs::create_directories(folder_ / "s/rgb");
        fs::create_directories(folder_ / "s/depth");
        camera(64, 48);
    }

    void camera(int width, int height, const std::string& more = "depth_units = 1000\n") {
        char text[200];
        std::snprintf(text, sizeof text,
                      "[CAMERA_PARAMS]\nresolution = [%d %d]\nfx = %d\nfy = %d\ncx = %.1f\n"
                      "cy = %.1f\n",
                      width, height, width, width, 0.5 * (width - 1), 0.5 * (height - 1));
        folder_.write("s/camera.ini", text + more);
    }

    void add(const cv::Mat3b& color, const cv::Mat1w& depth, double depth_late_s = 0) {
        const std::string name = std::to_string(frames_);
        cv::imwrite(folder_ / ("s/rgb/" + name + ".png"), color);
        cv::imwrite(folder_ / ("s/depth/" + name + ".png"), depth);
        const double stamp_s = 100 + 0.1 * frames_++;
        colors_ += std::to_string(stamp_s) + " rgb/" + name + ".png\n";
        depths_ += std::to_string(stamp_s + depth_late_s) + " depth/" + name + ".png\n";
    }

    ImportReport import(const ImportOptions& options = {}) const {
        folder_.write("s/rgb.txt", colors_);
        folder_.write("s/depth.txt", depths_);
        return importSequence(readTumSequence(folder_ / "s"),
                              readCameraFile(folder_ / "s/camera.ini"), rawlog(), options);
    }

    std::string complaint(const ImportOptions& options = {}) const {
        try {
            import(options);
        } catch (const Error& e) {
            EXPECT_FALSE(fs::exists(rawlog()));
            return e.what();
        }
        return "no error";
    }

    std::vector<CObservation3DRangeScan::Ptr> frames() const {
        RawlogReader reader(rawlog());
        std::vector<CObservation3DRangeScan::Ptr> frames;
        while (const auto observation = reader.next()) {
            const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
            if (frame) frames.push_back(frame);
        }
        return frames;
    }

    std::string rawlog() const { return folder_ / "out.rawlog"; }

    TestFolder folder_;
    int frames_ = 0;
    std::string colors_, depths_;
};

cv::Mat3b noise(int width, int height, int seed) {
    cv::Mat3b image(height, width);
    cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

/** Readings spread evenly, in raw values. */
cv::Mat1w readings(int width, int height, int seed, int nearest, int farthest) {
    cv::Mat1w depth(height, width);
    cv::RNG(seed).fill(depth, cv::RNG::UNIFORM, nearest, farthest);
    return depth;
}

TEST_F(ImportPlausibility, smallDepthIsResampledWithoutNewReadings) {
    for (int i = 0; i < 3; ++i) add(noise(64, 48, i), readings(32, 24, i, 0, 5000));
    EXPECT_THAT(import().notes, Contains(HasSubstr("32x24 pixels is resampled to color's 64x48")));
    const cv::Mat1w small = readings(32, 24, 1, 0, 5000);
    const cv::Mat1w large = toRgbdImage(frames().at(1)).depth;
    ASSERT_EQ(large.size(), cv::Size(64, 48));
    for (int v = 0; v < 48; ++v) {
        for (int u = 0; u < 64; ++u) ASSERT_EQ(large(v, u), small(v / 2, u / 2)) << u << " " << v;
    }
}

TEST_F(ImportPlausibility, depthOfAFractionIsResampledWhereAspectsAgree) {
    camera(60, 45);
    add(noise(60, 45, 0), readings(8, 6, 0, 1, 5000));  // 7.5 times, as iPhones have it
    import();
    const cv::Mat1w small = readings(8, 6, 0, 1, 5000);
    const cv::Mat1w large = toRgbdImage(frames().at(0)).depth;
    for (int u = 0; u < 60; ++u) {
        if (u % 15 == 7) continue;  // in the middle between two
        ASSERT_EQ(large(25, u), small(3, static_cast<int>((u + 0.5) / 7.5))) << u;
    }
}

TEST_F(ImportPlausibility, theUnitOfDepthThatIsRegisteredIsItsOwnCameras) {
    for (int i = 0; i < 3; ++i) add(noise(64, 48, i), readings(64, 48, i, 10, 100));
    ImportOptions options;
    options.strict = true;
    options.depth_camera = readCameraFile(folder_ / "s/camera.ini");
    options.depth_camera->name = "elsewhere/camera_depth.ini";
    EXPECT_THAT(complaint(options), HasSubstr("in camera_depth.ini"));
}

TEST_F(ImportPlausibility, depthOfAnotherAspectIsRefused) {
    add(noise(64, 48, 0), readings(64, 36, 0, 500, 4000));
    EXPECT_THAT(complaint(), HasSubstr("64x36 pixels, color 64x48"));
    EXPECT_THAT(complaint(), HasSubstr("--register"));
}

TEST_F(ImportPlausibility, calibrationOfLargerImagesIsResized) {
    camera(128, 96);
    add(noise(64, 48, 0), readings(64, 48, 0, 500, 4000));
    EXPECT_THAT(import().notes, Contains(HasSubstr("is for 128x96, the images have 64x48")));
    const Intrinsics camera = cameraOf(*frames().at(0));
    EXPECT_EQ(camera.width, 64);
    EXPECT_EQ(camera.fx, 64);
    EXPECT_EQ(camera.cx, 31.5);
}

TEST_F(ImportPlausibility, losingMostFramesIsAnErrorUnlessAskedFor) {
    for (int i = 0; i < 5; ++i) {
        add(noise(64, 48, i), readings(64, 48, i, 500, 4000), i < 3 ? 0.05 : 0);
    }
    EXPECT_THAT(complaint(), HasSubstr("only 2 of 5 frames"));
    ImportOptions options;
    options.allow_loss = true;
    EXPECT_EQ(import(options).frames, 2u);
}

TEST_F(ImportPlausibility, aConstantBeyondAllReadingsIsNoReading) {
    for (const int constant : {4000, 65535}) {
        SetUp();
        colors_ = depths_ = "";
        frames_ = 0;
        for (int i = 0; i < 6; ++i) {
            cv::Mat1w depth = readings(64, 48, i, 500, 3500);
            depth.colRange(0, 20).setTo(constant);
            add(noise(64, 48, i), depth);
        }
        const ImportReport report = import();
        EXPECT_THAT(report.notes,
                    Contains(HasSubstr("depth is exactly " + std::to_string(constant))));
        EXPECT_THAT(report.notes, Contains(HasSubstr("31 % of the pixels")));
        const cv::Mat1w depth = toRgbdImage(frames().at(2)).depth;
        EXPECT_EQ(cv::countNonZero(depth.colRange(0, 20)), 0);
        EXPECT_EQ(cv::countNonZero(depth), 44 * 48);
        ImportOptions keep;
        keep.no_reading = 0;
        import(keep);
        EXPECT_EQ(cv::countNonZero(toRgbdImage(frames().at(2)).depth), 64 * 48);
    }
}

TEST_F(ImportPlausibility, wallsAreNoLackOfReadings) {
    for (int i = 0; i < 6; ++i) {  // a bare wall, and a wall with noise behind furniture
        cv::Mat1w depth(48, 64, std::uint16_t{2000});
        if (i % 2 == 0) {
            depth = readings(64, 48, i, 3990, 4011);
            depth.colRange(0, 30).setTo(1500);
        }
        add(noise(64, 48, i), depth);
    }
    EXPECT_THAT(import().notes, IsEmpty());
}

TEST_F(ImportPlausibility, millimetersWithoutDepthUnitsAreFound) {
    camera(64, 48, "");
    for (int i = 0; i < 3; ++i) add(noise(64, 48, i), readings(64, 48, i, 700, 3500));
    const ImportReport report = import();
    EXPECT_THAT(report.warnings, Contains(HasSubstr("depth_units = 5000 (assumed")));
    EXPECT_THAT(report.warnings,
                Contains(HasSubstr("depth_units = 1000 would give a median of 2.1")));
    EXPECT_NEAR(report.depth_summary.median_m, 0.42, 0.01);
    EXPECT_THAT(toText(report), HasSubstr("depth: median 0.4"));
    fs::remove(rawlog());
    ImportOptions strict;
    strict.strict = true;
    EXPECT_THAT(complaint(strict), HasSubstr("depth_units = 1000 would give"));
    camera(64, 48);
    EXPECT_THAT(import(strict).warnings, IsEmpty());
}

TEST_F(ImportPlausibility, depthThatRgbdSlamWouldIgnoreIsTold) {
    camera(64, 48, "depth_units = 256\n");
    for (int i = 0; i < 3; ++i) add(noise(64, 48, i), readings(64, 48, i, 1024, 6144));
    EXPECT_THAT(import().notes, Contains(HasSubstr("depth_max_m is set below 2")));
}

TEST_F(ImportPlausibility, depthOfTwoCamerasInARawlogIsRegistered) {
    add(noise(64, 48, 0), readings(64, 48, 0, 1000, 1010));
    import();
    const auto frame = frames().at(0);
    frame->cameraParams.setIntrinsicParamsFromValues(40, 40, 31.5, 23.5);
    const Intrinsics depth = toCamera(frame->cameraParams), color = cameraOf(*frame);
    const SE3 T_color_depth(Eigen::Matrix3d::Identity(), {-0.02, 0, 0});
    frame->relativePoseIntensityWRTDepth =
        toCPose3D(T_optical_from_mrpt.inverse() * T_color_depth.inverse());
    const cv::Mat expected =
        DepthRegistration(depth, color, T_color_depth, 0.001)(readings(64, 48, 0, 1000, 1010));
    const RgbdImage image = toRgbdImage(frame);
    EXPECT_EQ(cv::norm(image.depth, expected, cv::NORM_INF), 0);
    EXPECT_NE(cv::norm(image.depth, readings(64, 48, 0, 1000, 1010), cv::NORM_INF), 0);
    frame->relativePoseIntensityWRTDepth = mrpt::poses::CPose3D();
    EXPECT_THROW(toRgbdImage(frame), Error) << "turned by 120 degrees";
    frame->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
    EXPECT_THROW(toRgbdImage(frame), Error);
}

TEST_F(ImportPlausibility, calibrationInARawlogForLargerImagesIsResized) {
    add(noise(64, 48, 0), readings(64, 48, 0, 500, 4000));
    import();
    const auto frame = frames().at(0);
    frame->cameraParamsIntensity = toTCamera(Intrinsics{128, 96, 120, 120, 63.5, 47.5, {}});
    frame->cameraParams = frame->cameraParamsIntensity;
    EXPECT_EQ(cameraOf(*frame).fx, 60);
    EXPECT_EQ(cameraOf(*frame).width, 64);
    EXPECT_EQ(toRgbdImage(frame).depth.cols, 64);
    frame->cameraParamsIntensity.nrows = 90;
    EXPECT_EQ(cameraOf(*frame).width, 128) << "no size to go by";
}

CObservation3DRangeScan::Ptr frameOfRobotLog(const std::string& name) {
    const char* data = std::getenv("RGBD_DATA");
    const fs::path path =
        fs::path(data ? data : RGBD_SOURCE_DIR "/../shared/data") / "robot-logs" / name;
    if (!fs::exists(path)) return nullptr;
    RawlogReader reader(path);
    while (const auto observation = reader.next()) {
        const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
        if (frame) return frame;
    }
    return nullptr;
}

TEST(RobotLog, depthOfItsOwnCameraIsRegistered) {
    const auto frame = frameOfRobotLog("tests_rgbd.rawlog");
    if (!frame) GTEST_SKIP() << "no data";
    const cv::Mat raw(static_cast<int>(frame->rangeImage.rows()),
                      static_cast<int>(frame->rangeImage.cols()), CV_16UC1,
                      frame->rangeImage.data());
    const RgbdImage image = toRgbdImage(frame);
    EXPECT_EQ(image.depth.size(), image.gray.size());
    EXPECT_GT(cv::countNonZero(image.depth), 0);
    if (raw.size() != image.depth.size()) return;
    EXPECT_GT(cv::countNonZero(image.depth != raw), cv::countNonZero(raw) / 2);
}

TEST(RobotLog, calibrationOfTwiceTheSizeIsResized) {
    const auto frame = frameOfRobotLog("test-3d-obs-ground.rawlog");
    if (!frame) GTEST_SKIP() << "no data";
    EXPECT_EQ(cameraOf(*frame).width, 320);
    EXPECT_EQ(cameraOf(*frame).fx, frame->cameraParamsIntensity.fx() / 2);
}

}  // namespace
}  // namespace rgbd_graphslam
