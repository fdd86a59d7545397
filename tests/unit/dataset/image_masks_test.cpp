/** What masks leave out goes through import, rawlog and export. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_export.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int frame_count = 3;

/** Black in a rectangle. */
cv::Mat maskWithout(const cv::Rect& rect) {
    cv::Mat mask(small_sequence::height, small_sequence::width, CV_8UC1, cv::Scalar(255));
    mask(rect) = 0;
    return mask;
}

class ImageMasks : public ::testing::Test {
  protected:
    void SetUp() override {
        setVerbosity(Verbosity::Quiet);
        small_sequence::make(folder_, "s", frame_count);
    }

    void write(const std::string& name, const cv::Mat& mask) const {
        fs::create_directories(fs::path(folder_ / name).parent_path());
        cv::imwrite(folder_ / name, mask);
    }

    std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> imported(
        const ImportOptions& options = {}) const {
        const RgbdSequence sequence = readTumSequence(folder_ / "s");
        importSequence(sequence, readCameraFile(folder_ / "s/camera.ini"), folder_ / "s.rawlog",
                       options);
        std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> frames;
        RawlogReader reader(folder_ / "s.rawlog");
        while (const auto observation = reader.next()) {
            const auto frame =
                std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
            if (frame) frames.push_back(frame);
        }
        return frames;
    }

    const cv::Rect arm_{0, 16, 32, 8}, hand_{10, 4, 5, 6};
    TestFolder folder_;
};

TEST_F(ImageMasks, withoutOneNothingIsLeftOut) {
    for (const auto& frame : imported()) {
        EXPECT_FALSE(frame->hasConfidenceImage);
        EXPECT_TRUE(toRgbdImage(frame).mask.empty());
    }
}

TEST_F(ImageMasks, thatOfTheRecordingAndThoseOfFramesAreJoined) {
    write("s/mask.png", maskWithout(arm_));
    write("s/mask/" + fs::path(small_sequence::colorFile(1)).filename().string(),
          maskWithout(hand_));
    for (const RawlogStorage storage :
         {RawlogStorage::Embedded, RawlogStorage::Compact, RawlogStorage::Small}) {
        ImportOptions options;
        options.storage = storage;
        const auto frames = imported(options);
        ASSERT_EQ(frames.size(), 3u);
        for (int i = 0; i < frame_count; ++i) {
            cv::Mat expected = maskWithout(arm_);
            if (i == 1) expected(hand_) = 0;
            const RgbdImage image = toRgbdImage(frames[i]);
            ASSERT_EQ(image.mask.size(), expected.size());
            EXPECT_EQ(cv::norm(image.mask, expected, cv::NORM_INF), 0) << i;
            EXPECT_EQ(cv::countNonZero(image.depth(arm_)), 0);
            EXPECT_GT(cv::countNonZero(image.depth), 0);
            const cv::Mat depth = small_sequence::depth(i);
            EXPECT_EQ(cv::norm(colorAndDepth(frames[i]).depth, depth, cv::NORM_INF), 0)
                << "the rawlog keeps all depth";
        }
        fs::remove_all(folder_ / "s_Images");
    }
}

TEST_F(ImageMasks, fileOnTheCommandLineReplacesTheFolders) {
    write("s/mask.png", maskWithout(arm_));
    write("other.png", maskWithout(hand_));
    ImportOptions options;
    options.mask_file = folder_ / "other.png";
    const RgbdImage image = toRgbdImage(imported(options).front());
    EXPECT_EQ(cv::norm(image.mask, maskWithout(hand_), cv::NORM_INF), 0);
}

TEST_F(ImageMasks, exportWritesThemBack) {
    write("s/mask.png", maskWithout(arm_));
    imported();
    exportTumSequence(folder_ / "s.rawlog", folder_ / "back", {});
    const fs::path name = fs::path(small_sequence::colorFile(0)).filename();
    const cv::Mat mask = cv::imread(fs::path(folder_ / "back/mask") / name, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(mask.type(), CV_8UC1);
    EXPECT_EQ(cv::norm(mask, maskWithout(arm_), cv::NORM_INF), 0);
    const cv::Mat depth =
        readDepthImage(folder_ / ("back/" + small_sequence::depthFile(0)), 5000).pixels;
    EXPECT_EQ(cv::norm(depth, small_sequence::depth(0), cv::NORM_INF), 0);
}

TEST_F(ImageMasks, thatDoNotFitAreRefused) {
    write("s/mask.png", cv::Mat(12, 16, CV_8UC1, cv::Scalar(0)));
    EXPECT_THAT(problemOf([&] { imported(); }), HasSubstr("16x12 pixels"));
    folder_.write("s/mask.png", "no image");
    EXPECT_THAT(problemOf([&] { imported(); }), HasSubstr("mask.png"));
}

}  // namespace
}  // namespace rgbd_graphslam
