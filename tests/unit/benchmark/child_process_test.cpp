#include "rgbd_graphslam/benchmark/child_process.h"

#include <gtest/gtest.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(ChildProcess, exitCodeLastLineAndCostAreTold) {
    const TestFolder folder;
    const auto child =
        runChild({"sh", "-c", "echo one; echo 'two words' >&2; echo; exit 3"}, folder / "log");
    EXPECT_EQ(child.exit_code, 3);
    EXPECT_FALSE(child.good());
    EXPECT_EQ(child.last_line, "two words");
    EXPECT_EQ(readText(folder / "log"), "one\ntwo words\n\n");
    EXPECT_GT(child.peak_memory_mb, 0.1);
    EXPECT_GT(child.wall_s, 0);
}

TEST(ChildProcess, argumentsAreNotInterpreted) {
    const TestFolder folder;
    EXPECT_EQ(runChild({"echo", "$HOME *; 'x'"}, folder / "log").last_line, "$HOME *; 'x'");
}

TEST(ChildProcess, aSignalIsNoSuccess) {
    const TestFolder folder;
    EXPECT_EQ(runChild({"sh", "-c", "kill -9 $$"}, folder / "log").exit_code, 128 + 9);
}

TEST(ChildProcess, whatCannotBeStartedIsAnError) {
    const TestFolder folder;
    EXPECT_THROW(runChild({"no-such-program-anywhere"}, folder / "log"), Error);
    EXPECT_THROW(runChild({"true"}, folder / "no-folder/log"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
