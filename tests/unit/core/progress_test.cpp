#include "rgbd_graphslam/core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "rgbd_graphslam/core/console.h"

namespace rgbd_graphslam {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr auto longer_than_a_redraw = std::chrono::milliseconds(120);
constexpr auto longer_than_a_plain_line = std::chrono::milliseconds(2050);

/** What `say` prints to stderr while that is a terminal. */
std::string saidToATerminal(const std::function<void()>& say) {
    int master = -1, slave = -1;
    if (openpty(&master, &slave, nullptr, nullptr, nullptr) != 0) return "no terminal to be had";
    const int saved = dup(STDERR_FILENO);
    dup2(slave, STDERR_FILENO);
    say();
    dup2(saved, STDERR_FILENO);
    close(saved);
    close(slave);  // the terminal hands on piece by piece; only its end says that nothing follows
    std::string text;
    char piece[256];
    for (ssize_t n; (n = read(master, piece, sizeof piece)) > 0;) text.append(piece, n);
    close(master);
    return text;
}

std::string saidToAFile(const std::function<void()>& say) {
    testing::internal::CaptureStderr();
    say();
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, drawsABarOnATerminal) {
    const std::string said = saidToATerminal([] {
        Progress progress("tracking", 4);
        std::this_thread::sleep_for(longer_than_a_redraw);
        progress.update(1, "7 keyframes");
    });
    EXPECT_THAT(said, StartsWith("\rtracking [#######.....................]  25 % 1/4 frames, "));
    EXPECT_THAT(said, AllOf(HasSubstr("/s, "), HasSubstr(" s left, 7 keyframes\x1b[K")));
    EXPECT_THAT(said, EndsWith("\n"));
}

TEST(Progress, isNotDrawnMoreOftenThanItCanBeSeen) {
    const std::string said = saidToATerminal([] {
        Progress progress("reading", 1000);
        for (int i = 0; i < 900; ++i) progress.update(i);
    });
    EXPECT_THAT(said, AllOf(Not(HasSubstr(" 10/1000")), HasSubstr(" 899/1000")));
}

TEST(Progress, countsWithoutATotal) {
    const std::string said = saidToATerminal([] {
        Progress progress("reading", 0, "images");
        progress.update(12);
    });
    EXPECT_THAT(said, StartsWith("\rreading 12 images, "));
    EXPECT_THAT(said, AllOf(Not(HasSubstr("%")), Not(HasSubstr("left"))));
}

TEST(Progress, neverShowsMoreThanAll) {
    const std::string said = saidToATerminal([] {
        Progress progress("tracking", 4);
        progress.update(6);
    });
    EXPECT_THAT(said, HasSubstr("[############################] 100 % 6/4 frames"));
}

TEST(Progress, saysNothingOfAShortJobToAFile) {
    EXPECT_THAT(saidToAFile([] { Progress("tracking", 4).update(4); }), IsEmpty());
}

TEST(Progress, saysALineInTwoSecondsToAFile) {
    const std::string said = saidToAFile([] {
        Progress progress("tracking", 40);
        std::this_thread::sleep_for(longer_than_a_plain_line);
        progress.update(3);  // not yet a tenth
        progress.update(10);
        progress.update(20);
    });
    EXPECT_THAT(said, StartsWith("tracking  25 % 10/40 frames, "));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST(Progress, isQuietWhenAsked) {
    setVerbosity(Verbosity::Quiet);
    const std::string said = saidToATerminal([] {
        Progress progress("tracking", 4);
        std::this_thread::sleep_for(longer_than_a_redraw);
        progress.update(1);
        std::fputs("end", stderr);
    });
    setVerbosity(Verbosity::Normal);
    EXPECT_EQ(said, "end");
}

}  // namespace
}  // namespace rgbd_graphslam
