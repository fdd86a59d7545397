/** Bad input to rgbd-eval ends in one clear line and an exit code, and leaves no file. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/run_program.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;

class FaultEval : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write("truth.txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 1 1 0 0 0 0 1\n");
        folder_.write("late.txt", "91 0 0 0 0 0 0 1\n92 1 0 0 0 0 0 1\n");
        folder_.write("short.txt", "1 0 0 0 0 0 0 1\n2 1 0\n");
        folder_.write("empty.txt", "# nothing\n");
        folder_.write("no.rawlog", "not a rawlog");
        folder_.write("no.ply", "ply\nformat ascii 1.0\nelement vertex 9\n");
    }

    /** \param arguments with % before the names of files of the folder */
    void expectRefused(const std::string& arguments, const std::string& reason) const {
        std::string line;
        for (const char c : arguments) line += c == '%' ? folder_ / "" : std::string(1, c);
        const auto result = runProgram("rgbd-eval", line);
        EXPECT_NE(result.exit_code, 0) << arguments;
        EXPECT_LT(result.exit_code, 128) << arguments;
        EXPECT_THAT(result.err, HasSubstr(reason)) << arguments;
        EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
        EXPECT_EQ(result.out, "") << arguments;
    }

    TestFolder folder_;
};

TEST_F(FaultEval, trajectories) {
    expectRefused("ate %absent.txt %truth.txt", "absent.txt");
    expectRefused("ate %empty.txt %truth.txt", "empty.txt");
    expectRefused("ate %short.txt %truth.txt", "short.txt:2");
    expectRefused("ate %late.txt %truth.txt", "late.txt: 0 poses match within 0.02 s");
    expectRefused("rpe %late.txt %truth.txt --max-pairs 0", "0 pairs of poses have a truth");
    expectRefused("ate %truth.txt %no.rawlog", "no.rawlog");
    expectRefused("ate %truth.txt", "At least 2");
}

TEST_F(FaultEval, options) {
    expectRefused("", "subcommand");
    expectRefused("ate %truth.txt %truth.txt --max-difference 0", "--max-difference");
    expectRefused("ate %truth.txt %truth.txt --scale nan", "--scale");
    expectRefused("ate %truth.txt %truth.txt --format word", "{text,csv,json,latex}");
    expectRefused("rpe %truth.txt %truth.txt --delta-unit km", "{s,m,rad,deg,f}");
    expectRefused("rpe %truth.txt %truth.txt --max-pairs -3", "--max-pairs");
}

TEST_F(FaultEval, masksAndMovers) {
    expectRefused("masks %absent %absent", "absent' holds no masks");
    expectRefused("masks %absent", "TRUE_DIR");
    folder_.write("points.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                  "property float y\nproperty float z\nend_header\n0 0 0\n");
    expectRefused("map %points.ply %points.ply --movers %truth.txt", "truth.txt:1");
    expectRefused("map %points.ply %points.ply --beyond 0", "--beyond");
    expectRefused("grid %truth.txt %points.ply", "truth.txt' describes no grid");
}

TEST_F(FaultEval, plots) {
    expectRefused("ate %truth.txt %truth.txt --plot %a.gif", ".png or .svg");
    expectRefused("ate %truth.txt %truth.txt --plot %absent/a.png", "absent/a.png");
}

TEST_F(FaultEval, lists) {
    expectRefused("associate %truth.txt %late.txt", "no stamps of the two lists");
    expectRefused("associate %truth.txt %absent.txt", "absent.txt");
}

TEST_F(FaultEval, cloudsAndMaps) {
    expectRefused("pointcloud %truth.txt %truth.txt %a.ply", "truth.txt");
    expectRefused("pointcloud %truth.txt %a.ply", "RGB DEPTH OUT.ply");
    expectRefused("pointcloud --pairs %truth.txt %a.ply", "--trajectory");
    expectRefused("pointcloud %truth.txt %truth.txt %a.ply --camera %absent.ini", "absent.ini");
    expectRefused("map %no.ply %no.ply", "no.ply");
    expectRefused("map %no.ply %no.ply --estimate %truth.txt", "--truth");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.ply"));
}

}  // namespace
}  // namespace rgbd_graphslam
