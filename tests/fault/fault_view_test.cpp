/** The window beside a running rgbd-slam. */
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "../support/run_program.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

class FaultView : public ::testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0) {
            GTEST_SKIP() << "xvfb-run is not installed (apt-get install xvfb)";
        }
        const std::string command = "XDG_CONFIG_HOME='" + folder_ / "" +
                                    "' xvfb-run -a sh -c '\"" RGBD_BINARY_DIR
                                    "/bin/rgbd-viewer\" --follow \"" +
                                    folder_ / "out" + "\" & echo $! >\"" + folder_ / "pid" +
                                    "\"; wait' >/dev/null 2>&1 </dev/null &";
        fs::create_directories(folder_ / "out");
        ASSERT_EQ(std::system(command.c_str()), 0);
    }
    void TearDown() override {
        if (viewer() > 0) ::kill(viewer(), SIGTERM);
    }

    pid_t viewer() const {
        const std::string pid = fs::exists(folder_ / "pid") ? readText(folder_ / "pid") : "";
        return pid.empty() ? 0 : std::stoi(pid);
    }
    /** Of each of its threads; none while it has not begun. */
    std::vector<int> policies() const {
        std::vector<int> policies;
        std::error_code none;
        const std::string tasks = "/proc/" + std::to_string(viewer()) + "/task";
        for (const auto& thread : fs::directory_iterator(tasks, none))
            policies.push_back(::sched_getscheduler(std::stoi(thread.path().filename())));
        return policies;
    }
    long standingBack() const {
        const auto all = policies();
        return std::count(all.begin(), all.end(), SCHED_IDLE);
    }
    template <class Condition>
    static bool soon(const Condition& condition) {
        for (int i = 0; i < 600 && !condition(); ++i) std::this_thread::sleep_for(100ms);
        return condition();
    }

    TestFolder folder_;
};

TEST_F(FaultView, standsBackWhenTheRunIsOnTheScreen) {
    const auto drawing_threads_are_there = [&] { return policies().size() > 1; };
    ASSERT_TRUE(soon(drawing_threads_are_there));
    EXPECT_EQ(standingBack(), 0);
    const ProgramResult run =
        runProgram("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" RGBD_SOURCE_DIR
                                "/rawlogs/office_sample.rawlog' --no-maps --quiet -o '" +
                                    folder_ / "out" + "'");
    EXPECT_EQ(run.exit_code, 0);
    const auto all_stand_back = [&] {
        return standingBack() > 1 && standingBack() == static_cast<long>(policies().size());
    };
    EXPECT_TRUE(soon(all_stand_back));
}

}  // namespace
}  // namespace rgbd_graphslam
