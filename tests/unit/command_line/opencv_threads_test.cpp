/** Threads in a program are ours: OpenCV has none beside them. */
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <set>
#include <thread>

#include "../../../apps/command_line.h"

namespace rgbd_graphslam {
namespace {

/** \return how many threads OpenCV gives a loop that has work for many */
std::size_t threadsOfALoop() {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    cv::parallel_for_(cv::Range(0, 40), [&](const cv::Range&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard<std::mutex> lock(mutex);
        threads.insert(std::this_thread::get_id());
    });
    return threads.size();
}

TEST(OpenCvInAProgram, hasNoThreadsOfItsOwn) {
    if (cv::getNumThreads() < 2) GTEST_SKIP() << "OpenCV has one thread here anyway";
    CLI::App app("test", "program");
    std::string name = "program";
    char* argv[] = {name.data(), nullptr};
    int allowed = 0;
    std::size_t in_main = 0, in_another = 0;
    const int exit_code = runProgram(app, 1, argv, [&] {
        allowed = cv::getNumThreads();
        in_main = threadsOfALoop();
        std::thread([&] { in_another = threadsOfALoop(); }).join();
        return 0;
    });
    EXPECT_EQ(exit_code, 0);
    EXPECT_EQ(allowed, 1);
    EXPECT_EQ(in_main, 1u);
    EXPECT_EQ(in_another, 1u);
}

}  // namespace
}  // namespace rgbd_graphslam
