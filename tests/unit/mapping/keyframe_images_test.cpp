/** The stores that maps take keyframe images from. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "../../support/problem_of.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/mapping/image_spool.h"
#include "rgbd_graphslam/mapping/masked_images.h"
#include "rgbd_graphslam/mapping/packed_images.h"
#include "rgbd_graphslam/mapping/recorded_images.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr int frames = 4;

double stampOf(int frame) {
    return 1000 + 0.1 * frame;
}

/** Every pixel tells the frame's number. */
RgbdImage imageOf(int frame) {
    RgbdImage image;
    image.stamp_s = stampOf(frame);
    image.color = cv::Mat(6, 8, CV_8UC3, cv::Scalar(10 + frame, 20, 30));
    image.depth = cv::Mat(6, 8, CV_16U, cv::Scalar(500 + frame));
    return image;
}

CameraSetup smallCamera() {
    CameraSetup setup;
    setup.camera.width = 8;
    setup.camera.height = 6;
    setup.camera.fx = setup.camera.fy = 8;
    setup.camera.cx = 3.5;
    setup.camera.cy = 2.5;
    return setup;
}

mrpt::obs::CObservation3DRangeScan::Ptr frameOf(int frame, const std::string& label = "CAMERA") {
    const RgbdImage image = imageOf(frame);
    const auto observation = makeRgbdObservation(smallCamera(), image.stamp_s);
    observation->sensorLabel = label;
    setColor(*observation, image.color);
    setDepth(*observation, image.depth);
    return observation;
}

Trajectory posesOf(const std::vector<int>& numbers) {
    Trajectory poses;
    for (const int number : numbers) poses.push_back({stampOf(number), SE3()});
    return poses;
}

/** \return the numbers of the frames as their pixels tell them, each at the index that was asked
 *          for */
std::vector<int> framesIn(const KeyframeImages& images, const std::vector<int>& asked,
                          const KeyframeImages::Note& note = {}) {
    std::vector<int> found;
    images.forEach(
        posesOf(asked), "test",
        [&](const Keyframe3D& keyframe) {
            const int number = keyframe.image.depth.at<std::uint16_t>(3, 3) - 500;
            EXPECT_EQ(keyframe.image.color.at<cv::Vec3b>(3, 3)[0], 10 + number);
            EXPECT_EQ(asked[keyframe.index], number);
            EXPECT_EQ(keyframe.camera.width, 8);
            found.push_back(number);
        },
        note);
    return found;
}

class KeyframeImagesTest : public testing::Test {
  protected:
    KeyframeImagesTest() { fs::create_directories(folder_); }
    ~KeyframeImagesTest() override { fs::remove_all(folder_); }

    /** Each frame behind a reading, and behind one of another camera with the same stamp.
     *  \return where the frames are */
    FrameEntries writeRecording() const {
        FrameEntries entries;
        writeRawlog(rawlog_, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (int i = 0; i < frames; ++i) {
                mrpt::obs::CObservationIMU imu;
                imu.timestamp = toMrptTime(stampOf(i));
                writer.write(imu);
                writer.write(*frameOf(i + 100, "OTHER"));
                writer.write(*frameOf(i));
                entries.push_back({stampOf(i), static_cast<std::size_t>(3 * i + 2)});
            }
        });
        return entries;
    }

    const fs::path folder_ =
        fs::path(testing::TempDir()) / ("rgbd-keyframe-images-" + std::to_string(getpid()));
    const std::string rawlog_ = (folder_ / "walk.rawlog").string();
};

TEST_F(KeyframeImagesTest, recordingGivesTheEntriesThatTheRunFound) {
    const FrameEntries entries = writeRecording();
    const RecordedImages images({rawlog_, "", entries});
    EXPECT_EQ(framesIn(images, {0, 2, 3}), (std::vector<int>{0, 2, 3}));
    int readings = 0;
    framesIn(images, {1}, [&](const auto& entry) {
        readings += dynamic_cast<const mrpt::obs::CObservationIMU*>(&entry) != nullptr;
    });
    EXPECT_EQ(readings, frames);
}

TEST_F(KeyframeImagesTest, recordingWithoutEntriesIsSearchedForTheStampsOfItsCamera) {
    writeRecording();
    EXPECT_EQ(framesIn(RecordedImages({rawlog_, "CAMERA"}), {0, 2, 3}),
              (std::vector<int>{0, 2, 3}));
}

TEST_F(KeyframeImagesTest, entriesOfAnotherRecordingGiveNoImages) {
    FrameEntries entries = writeRecording();
    for (FrameEntry& frame : entries) ++frame.entry;  // readings
    const RecordedImages shifted({rawlog_, "", entries});
    EXPECT_THAT(problemOf([&] { framesIn(shifted, {0, 1}); }), testing::HasSubstr("--rawlog"));
    for (FrameEntry& frame : entries) frame.entry += 2;  // the next frame
    const RecordedImages late({rawlog_, "", entries});
    EXPECT_THAT(problemOf([&] { framesIn(late, {0, 1}); }), testing::HasSubstr("--rawlog"));
}

TEST_F(KeyframeImagesTest, memoryGivesBackEveryPixelOfWhatWasNotDropped) {
    PackedImages images{Camera(smallCamera().camera)};
    for (int i = 0; i < frames; ++i) images.add(imageOf(i));
    images.drop(stampOf(2));
    EXPECT_TRUE(images.has(stampOf(1)));
    EXPECT_FALSE(images.has(stampOf(2)));
    EXPECT_EQ(framesIn(images, {0, 2, 3}), (std::vector<int>{0, 3}));
    EXPECT_NE(problemOf([&] { framesIn(images, {2}); }), "");
}

TEST_F(KeyframeImagesTest, spoolKeepsKeyframesAndReadingsOfARunWithoutRecording) {
    ImageSpool spool(rawlog_);
    for (int i = 0; i < frames; ++i) {
        const auto imu = mrpt::obs::CObservationIMU::Create();
        imu->timestamp = toMrptTime(stampOf(i));
        EXPECT_TRUE(spool.note(imu));
        if (i == 1) continue;
        EXPECT_TRUE(spool.add(frameOf(i)));
    }
    const RecordedCamera spooled = spool.finish();
    EXPECT_EQ(spooled.entries.size(), 3u);
    int readings = 0;
    const WarningRecord warnings;
    const auto found = framesIn(RecordedImages(spooled), {0, 1, 3}, [&](const auto& entry) {
        readings += dynamic_cast<const mrpt::obs::CObservationIMU*>(&entry) != nullptr;
    });
    EXPECT_EQ(found, (std::vector<int>{0, 3}));
    EXPECT_EQ(readings, frames);
    EXPECT_EQ(warnings.warnings().size(), 1u);  // frame 1 is left out
}

TEST_F(KeyframeImagesTest, spoolThatIsGivenUpLeavesNoFile) {
    {
        ImageSpool spool(rawlog_);
        spool.add(frameOf(0));
    }
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(KeyframeImagesTest, spoolThatCannotBeWrittenSaysSo) {
    fs::create_directories(rawlog_);
    ImageSpool spool(rawlog_);
    spool.add(frameOf(0));
    EXPECT_THAT(problemOf([&] { spool.finish(); }), testing::HasSubstr("walk.rawlog"));
}

TEST_F(KeyframeImagesTest, maskedClassesHaveNoDepth) {
    writeRawlog(rawlog_, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        mrpt::obs::CObservationComment names;
        names.text = toComment({{1, {"wall", {}}}, {2, {"person", {}}}});
        writer.write(names);
        for (int i = 0; i < frames; ++i) {
            cv::Mat1w labels(6, 8, std::uint16_t{1});
            labels.row(i) = 2;
            for (const auto& image : makeLabelObservations("CAMERA", stampOf(i), labels))
                writer.write(*image);
            writer.write(*frameOf(i));
        }
    });
    const MaskedImages images(std::make_unique<RecordedImages>(RecordedCamera(rawlog_)), "",
                              "dog person");
    int seen = 0;
    images.forEach(posesOf({0, 1, 2, 3}), "test", [&](const Keyframe3D& keyframe) {
        const auto i = static_cast<int>(keyframe.index);
        EXPECT_EQ(cv::countNonZero(keyframe.image.depth), 5 * 8);
        EXPECT_EQ(cv::countNonZero(keyframe.image.depth.row(i)), 0);
        ++seen;
    });
    EXPECT_EQ(seen, frames);
}

TEST_F(KeyframeImagesTest, listsOfEntriesAreReadAsTheyAreWritten) {
    const std::string path = (folder_ / frame_entries_name).string();
    EXPECT_TRUE(readFrameEntries(path).empty());
    const std::vector<FrameEntries> written{{{1.25, 3}, {1.5, 7}}, {{0.5, 0}}};
    writeTextAtomically(path, frameEntriesCsv(written));
    const auto read = readFrameEntries(path);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(entryAt(read[0], 1.5), 7u);
    EXPECT_EQ(entryAt(read[0], 1.4), std::nullopt);
    EXPECT_EQ(entryAt(read[1], 0.5000004), 0u);
    writeTextAtomically(path, frameEntriesCsv({{}, {}, {{0.5, 8}}}));
    EXPECT_EQ(entryAt(readFrameEntries(path).at(2), 0.5), 8u) << "behind sessions without entries";
    for (const char* line : {"x", "0,1.5", "0,1.5,2,3", "20000,1.5,2"}) {
        writeTextAtomically(path, std::string("session,stamp_s,entry\n") + line + "\n");
        EXPECT_THAT(problemOf([&] { readFrameEntries(path); }), testing::HasSubstr("csv:2"))
            << line;
    }
    writeTextAtomically(path, "session,stamp_s,entry\n0,1.5,3\n0,1.5,4\n");
    EXPECT_THAT(problemOf([&] { readFrameEntries(path); }), testing::HasSubstr("csv:3"));
}

}  // namespace
}  // namespace rgbd_graphslam
