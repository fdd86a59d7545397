#include "rgbd_graphslam/graphslam/live_slam.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "../../support/textured_room.h"

namespace rgbd_graphslam {
namespace {

constexpr double turn_rad = 0.05;
/** One round takes 126 frames. */
constexpr int whole_film = 140;

/** Lets one thread wait for what another counts. */
class Counter {
  public:
    void add() {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++count_;
        changed_.notify_all();
    }
    void waitFor(int count) {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [&] { return count_ >= count; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int count_ = 0;
};

TEST(LiveSlam, reportsWhatASessionFedByHandFinds) {
    const auto film = filmRoundTrip(whole_film, turn_rad);
    GraphSlamSession by_hand({}, *film.front());
    for (const auto& frame : film) by_hand.step(frame);
    by_hand.finish();

    GraphSlamSession session({}, *film.front());
    Counter done;
    std::vector<int> keyframes;
    std::vector<PoseEdge> loops;
    LiveSlamCallbacks callbacks;
    callbacks.on_frame = [&](const TrackedFrame&) { done.add(); };
    callbacks.on_keyframe = [&](const TrackedFrame& frame) {
        keyframes.push_back(*frame.keyframe);
    };
    callbacks.on_loop = [&](const PoseEdge& loop) { loops.push_back(loop); };
    LiveSlam slam(session, callbacks);
    for (int i = 0; i < whole_film; ++i) {
        EXPECT_TRUE(slam.push(film[i])) << i;
        done.waitFor(i + 1);
    }
    slam.finish();

    EXPECT_EQ(slam.dropped(), 0u);
    EXPECT_EQ(keyframes.size(), by_hand.slam().keyframes().size());
    EXPECT_FALSE(loops.empty());
    const auto expected = by_hand.slam().frames(), frames = session.slam().frames();
    ASSERT_EQ(frames.size(), expected.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].T_world_cam.t, expected[i].T_world_cam.t) << i;
    }
}

TEST(LiveSlam, dropsTheOldestWaitingFramesWhenBehind) {
    constexpr int frames = 10;
    const auto film = filmRoundTrip(frames, 0.01);
    GraphSlamSession session({}, *film.front());
    Counter begun, go_on;
    std::vector<double> stamps_s;
    LiveSlamCallbacks callbacks;
    callbacks.on_frame = [&](const TrackedFrame& frame) {
        stamps_s.push_back(frame.stamp_s);
        begun.add();
        go_on.waitFor(1);
    };
    LiveSlam slam(session, callbacks);
    slam.push(film[0]);
    begun.waitFor(1);
    for (int i = 1; i < frames; ++i) {
        EXPECT_EQ(slam.push(film[i]), i <= int(LiveSlam::max_waiting)) << i;
    }
    go_on.add();
    slam.finish();
    EXPECT_EQ(slam.dropped(), frames - 1 - LiveSlam::max_waiting);
    ASSERT_EQ(stamps_s.size(), 1 + LiveSlam::max_waiting);
    EXPECT_EQ(stamps_s.back(), toSeconds(film.back()->timestamp));
}

TEST(LiveSlam, tellsOfUnusableFramesAndGoesOn) {
    const auto film = filmRoundTrip(3, 0.01);
    GraphSlamSession session({}, *film.front());
    film[1]->hasRangeImage = false;
    int tracked = 0;
    std::vector<std::string> problems;
    LiveSlamCallbacks callbacks;
    callbacks.on_frame = [&](const TrackedFrame&) { ++tracked; };
    callbacks.on_unusable = [&](const std::string& why) { problems.push_back(why); };
    LiveSlam slam(session, callbacks);
    for (const auto& frame : film) slam.push(frame);
    slam.finish();
    EXPECT_EQ(tracked, 2);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find("depth"), std::string::npos) << problems[0];
}

TEST(LiveSlam, finishThrowsWhatACallbackThrew) {
    const auto film = filmRoundTrip(2, 0.01);
    GraphSlamSession session({}, *film.front());
    LiveSlamCallbacks callbacks;
    callbacks.on_frame = [](const TrackedFrame&) { throw std::runtime_error("mine"); };
    LiveSlam slam(session, callbacks);
    slam.push(film[0]);
    slam.push(film[1]);
    EXPECT_THROW(slam.finish(), std::runtime_error);
}

}  // namespace
}  // namespace rgbd_graphslam
