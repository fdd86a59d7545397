/** Names of files and what is in them are neither commands nor orders to a terminal. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/run_program.h"
#include "../support/textured_room.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

/** To a shell, to gnuplot and to a terminal this would say something. */
const std::string odd = "a$(touch x1)`touch x2`;touch x3;'\"|touch x4\n!touch x5\n\x1b[2J\xff";

std::string inQuotes(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

class FaultNames : public testing::Test {
  protected:
    void SetUp() override { fs::current_path(folder_ / ""); }
    void TearDown() override {
        fs::current_path(fs::temp_directory_path());
        for (const char* file : {"x1", "x2", "x3", "x4", "x5"}) {
            EXPECT_FALSE(fs::exists(folder_ / file)) << file;
        }
    }
    static void expectPrintable(const std::string& text) {
        for (const unsigned char c : text) {
            EXPECT_TRUE(c == '\n' || (c >= ' ' && c < 0x7f)) << +c << " in: " << text;
        }
    }
    /** One line, in letters. */
    static void expectRefused(const std::string& program, const std::string& arguments) {
        const ProgramResult result = runProgram(program, arguments);
        EXPECT_EQ(result.exit_code, 1) << program;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        expectPrintable(result.err);
        expectPrintable(result.out);
    }

    const TestFolder folder_;
    const std::string ini_ = inQuotes(RGBD_SOURCE_DIR "/ini/default.ini");
};

TEST_F(FaultNames, ofFilesThatAreNotThere) {
    const std::string name = inQuotes(folder_ / odd);
    expectRefused("rgbd-eval", "ate " + name + " " + name);
    expectRefused("rgbd-slam", ini_ + " " + name + " -o out");
    expectRefused("rgbd-slam", name + " " + name + " -o out");
    expectRefused("rgbd-import", name + " out.rawlog");
    expectRefused("rawlog2tum", name + " out");
    expectRefused("rgbd-map", name);
    expectRefused("rgbd-export", name + " --to tum");
    expectRefused("rgbd-export", ". --to " + inQuotes(odd));
}

TEST_F(FaultNames, inWhatIsReadAreShownInLetters) {
    folder_.write("a.ini", "[TrackerOptions]\n\x1b[2J\xff = 3\n");
    expectRefused("rgbd-slam", "a.ini a.rawlog -o out");
    folder_.write("a.txt", "1 0 0 0 0 0 0 1\n2 \x1b[2J\xff\n");
    expectRefused("rgbd-eval", "ate a.txt a.txt");
    folder_.write("s/rgb.txt", "\x1b[2J\xff 1\n");
    expectRefused("rgbd-import", "s out.rawlog");
}

TEST_F(FaultNames, plotsAreMadeOfAndAs) {
    if (std::system("command -v gnuplot >/dev/null") != 0) GTEST_SKIP() << "no gnuplot";
    folder_.write(odd + ".txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 1 1 0 0 0 0 1\n");
    const std::string file = inQuotes(odd + ".txt"), plot = inQuotes(odd + ".svg");
    const ProgramResult result =
        runProgram("rgbd-eval", "ate " + file + " " + file + " --format json --plot " + plot);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(readText(odd + ".svg"), testing::HasSubstr("</svg>"));
    expectPrintable(result.err);
}

TEST_F(FaultNames, sequencesAreRunByTheirName) {
    fs::create_directory("in");
    writeRawlog(folder_ / ("in/" + odd + ".rawlog"), RawlogStorage::Embedded,
                [](RawlogWriter& writer) {
                    for (const auto& frame : filmRoundTrip(4, 0.02)) writer.write(*frame);
                });
    const ProgramResult result = runProgram("rgbd-benchmark", "in -o out --no-maps");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::exists("out/report.md"));
    expectPrintable(result.out);
    expectPrintable(result.err);
}

}  // namespace
}  // namespace rgbd_graphslam
