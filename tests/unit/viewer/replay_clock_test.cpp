#include "rgbd_graphslam/viewer/replay_clock.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

ReplayClock::TimePoint at(int ms) {
    return ReplayClock::TimePoint(std::chrono::milliseconds(ms));
}

class AReplay : public testing::Test {
  protected:
    AReplay() { clock_.reset(1000, 1010); }
    ReplayClock clock_;
};

TEST_F(AReplay, beginsWithTheWholeRun) {
    EXPECT_FALSE(clock_.now());
    EXPECT_EQ(clock_.share(), 1);
    EXPECT_EQ(clock_.text(), "10.0 / 10.0 s");
}

TEST_F(AReplay, goesOnAsFastAsTheRunWasRecorded) {
    clock_.play(true, at(0));
    EXPECT_EQ(clock_.now(), 1000);
    EXPECT_TRUE(clock_.advance(at(2500)));
    EXPECT_EQ(clock_.now(), 1002.5);
    EXPECT_EQ(clock_.text(), "2.5 / 10.0 s");
    EXPECT_DOUBLE_EQ(clock_.share(), 0.25);
}

TEST_F(AReplay, endsWithTheWholeRun) {
    clock_.moveTo(1009);
    clock_.play(true, at(0));
    EXPECT_TRUE(clock_.advance(at(1500)));
    EXPECT_FALSE(clock_.now());
    EXPECT_FALSE(clock_.playing());
}

TEST_F(AReplay, standsStillUnlessItPlays) {
    clock_.moveToShare(0.5);
    EXPECT_FALSE(clock_.advance(at(1000)));
    EXPECT_EQ(clock_.now(), 1005);
    clock_.moveToShare(1);
    EXPECT_FALSE(clock_.now());
}

TEST_F(AReplay, ofOneMomentCannotPlay) {
    clock_.reset(7, 7);
    clock_.play(true, at(0));
    EXPECT_FALSE(clock_.playing());
    EXPECT_FALSE(clock_.now());
}

}  // namespace
}  // namespace rgbd_graphslam
