/** Lists as people's own tools write them: other units, commas, backslashes, one line per pair. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../../libs/dataset/src/stamp_unit.h"
#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using small_sequence::colorStamp;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int frames = 4;

std::string stampIn(double seconds, double unit_s, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, seconds / unit_s);
    return text;
}

class ListForms : public ::testing::Test {
  protected:
    void SetUp() override {
        setVerbosity(Verbosity::Quiet);
        small_sequence::make(folder_, "s", frames);
        fs::remove(folder_ / "s/rgb.txt");
        fs::remove(folder_ / "s/depth.txt");
    }

    void write(const std::string& name, const std::string& text) const {
        folder_.write("s/" + name, text);
    }

    /** One line per frame. \param form takes the places of {}: stamp, color, stamp, depth */
    std::string pairs(double unit_s = 1, int decimals = 6, const std::string& end = "\n") const {
        std::string text;
        for (int i = 0; i < frames; ++i) {
            text += stampIn(colorStamp(i), unit_s, decimals) + " " + small_sequence::colorFile(i) +
                    " " + stampIn(colorStamp(i) + 0.0055, unit_s, decimals) + " " +
                    small_sequence::depthFile(i) + end;
        }
        return text;
    }

    RgbdSequence read() const {
        const std::string source = folder_ / "s";
        return readSequence(source, detectLayout(source), 30);
    }

    void expectFrames(const RgbdSequence& sequence) const {
        ASSERT_EQ(sequence.color.size(), std::size_t(frames));
        for (int i = 0; i < frames; ++i) {
            EXPECT_NEAR(sequence.color[i].stamp_s, colorStamp(i), 1e-3);
            EXPECT_EQ(sequence.color[i].file, small_sequence::colorFile(i));
        }
        const ImportReport report = importSequence(
            sequence, readCameraFile(folder_ / "s/camera.ini"), folder_ / "s.rawlog", {});
        EXPECT_EQ(report.frames, std::size_t(frames));
    }

    TestFolder folder_;
};

TEST_F(ListForms, associationsWithStampsKeepMotionAndTruth) {
    write("associations.txt", pairs());
    write("groundtruth.txt", "1305031453.36 1 2 3 0 0 0 1\n");
    write("accelerometer.txt", "1305031453.37 0 9.8 0\n");
    const RgbdSequence sequence = read();
    EXPECT_EQ(detectLayout(folder_ / "s"), SequenceLayout::Associations);
    EXPECT_EQ(sequence.truth.size(), 1u);
    EXPECT_EQ(sequence.acceleration.size(), 1u);
    EXPECT_THAT(sequence.notes, IsEmpty());
    expectFrames(sequence);
}

TEST_F(ListForms, associationsOfOtherUnitsAndLineEnds) {
    const std::vector<std::pair<double, std::string>> units = {
        {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}};
    for (const auto& [unit_s, name] : units) {
        write("associations.txt", "\xef\xbb\xbf" + pairs(unit_s, 0, "\r\n"));
        const RgbdSequence sequence = read();
        EXPECT_THAT(sequence.notes, Contains(HasSubstr(name)));
        expectFrames(sequence);
    }
}

TEST_F(ListForms, associationsThatAreNumbered) {
    std::string text;
    for (int i = 0; i < frames; ++i) {
        text += std::to_string(i) + " " + small_sequence::colorFile(i) + " " + std::to_string(i) +
                " " + small_sequence::depthFile(i) + "\n";
    }
    write("associate.txt", text);
    const RgbdSequence sequence = read();
    EXPECT_NEAR(sequence.color.at(3).stamp_s, 0.1, 1e-9);
    EXPECT_THAT(sequence.notes, Contains(HasSubstr("numbered")));
}

TEST_F(ListForms, associationsOfThreeColumns) {
    std::string text;
    for (int i = 0; i < frames; ++i) {
        text += stampIn(colorStamp(i), 1, 6) + " " + small_sequence::colorFile(i) + " " +
                small_sequence::depthFile(i) + "\n";
    }
    write("associations.txt", text);
    expectFrames(read());
    write("associations.txt", "1.5 a.png b.png\n");
    EXPECT_THAT(problemOf([&] { read(); }), HasSubstr("associations.txt:1: cannot tell color"));
}

TEST_F(ListForms, decimalCommasBackslashesQuotesAndColumns) {
    std::string color, depth;
    for (int i = 0; i < frames; ++i) {
        std::string stamp = stampIn(colorStamp(i), 1, 6), file = small_sequence::colorFile(i);
        stamp.replace(stamp.find('.'), 1, ",");
        file.replace(file.find('/'), 1, "\\");
        color += stamp + " " + file + "\n";
        depth += stampIn(colorStamp(i), 1, 6) + " \"" + small_sequence::depthFile(i) + "\" 0.5 1\n";
    }
    write("rgb.txt", color);
    write("depth.txt", depth);
    const RgbdSequence sequence = read();
    EXPECT_THAT(sequence.notes, Contains("rgb.txt: commas are taken as decimal points"));
    EXPECT_THAT(sequence.notes,
                Contains("rgb.txt: backslashes in file names are taken as slashes"));
    EXPECT_THAT(sequence.notes, Contains("depth.txt: columns after the file name are ignored"));
    expectFrames(sequence);
}

TEST_F(ListForms, commasAndSemicolonsThatSeparate) {
    std::string color, depth;
    for (int i = 0; i < frames; ++i) {
        color += stampIn(colorStamp(i), 1, 6) + "," + small_sequence::colorFile(i) + "\n";
        depth += stampIn(colorStamp(i), 1, 6) + ";" + small_sequence::depthFile(i) + "\n";
    }
    write("rgb.txt", color);
    write("depth.txt", depth);
    write("accelerometer.txt", "1305031453.37,1,2,3\n");
    const RgbdSequence sequence = read();
    EXPECT_EQ(sequence.acceleration.at(0).value, Eigen::Vector3d(1, 2, 3));
    EXPECT_THAT(sequence.notes, IsEmpty());
    expectFrames(sequence);
}

TEST_F(ListForms, eachListOfTumsHasAUnitOfItsOwn) {
    std::string color, depth;
    for (int i = 0; i < frames; ++i) {
        color += stampIn(colorStamp(i), 1e-3, 3) + " " + small_sequence::colorFile(i) + "\n";
        depth += stampIn(colorStamp(i), 1e-9, 0) + " " + small_sequence::depthFile(i) + "\n";
    }
    write("rgb.txt", color);
    write("depth.txt", depth);
    write("groundtruth.txt", "1305031453.36 1 2 3 0 0 0 1\n");
    write("gyroscope.txt", "1305031453370000 1 2 3\n");
    const RgbdSequence sequence = read();
    EXPECT_NEAR(sequence.truth.at(0).stamp_s, 1305031453.36, 1e-6);
    EXPECT_NEAR(sequence.angular_velocity.at(0).stamp_s, 1305031453.37, 1e-6);
    expectFrames(sequence);
}

TEST_F(ListForms, whatIsNoTimeIsRefusedByName) {
    write("rgb.txt", "1e30 rgb/a.png\n");
    write("depth.txt", "1e30 depth/a.png\n");
    EXPECT_THAT(problemOf([&] { read(); }), HasSubstr("which is no time in any unit"));
    write("rgb.txt", std::string("\xff\xfe"
                                 "1\0",
                                 4));
    EXPECT_THAT(problemOf([&] { read(); }), HasSubstr("rgb.txt' is UTF-16"));
}

TEST(StampUnit, byMagnitudeAndStep) {
    const auto unit = [](double first, double step) {
        return std::string(unitOfStamps({first, first + step, first + 2 * step}).name);
    };
    EXPECT_EQ(unit(1.3e9, 0.033), "seconds");
    EXPECT_EQ(unit(1.3e9, 5), "seconds") << "a slow recording";
    EXPECT_EQ(unit(0, 1), "seconds");
    EXPECT_EQ(unit(1.3e12, 33), "milliseconds");
    EXPECT_EQ(unit(120, 33), "milliseconds");
    EXPECT_EQ(unit(1.3e15, 33333), "microseconds");
    EXPECT_EQ(unit(1.1e9, 33333), "microseconds") << "since the machine was started";
    EXPECT_EQ(unit(1.3e18, 33e6), "nanoseconds");
    EXPECT_EQ(unit(0, 33e6), "nanoseconds");
    EXPECT_STREQ(unitOfStamps({}).name, "seconds");
}

TEST(StampUnit, frameNumbersCountByOneOrByOneStride) {
    EXPECT_TRUE(areFrameNumbers({0, 1, 2, 4}));
    EXPECT_TRUE(areFrameNumbers({10, 20, 30, 50}));
    EXPECT_FALSE(areFrameNumbers({0, 33, 67, 100}));
    EXPECT_FALSE(areFrameNumbers({0, 0.5, 1}));
    EXPECT_FALSE(areFrameNumbers({1305031453, 1305031454, 1305031455}));
}

}  // namespace
}  // namespace rgbd_graphslam
