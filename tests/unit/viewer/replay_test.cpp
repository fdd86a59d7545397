#include "rgbd_graphslam/viewer/replay.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

/** A frame a second from 100 s on, each second one per keyframe. */
RunData tenSeconds() {
    RunData run;
    for (int i = 0; i <= 10; ++i) {
        const StampedPose pose{100.0 + i, SE3(Eigen::Matrix3d::Identity(), {1.0 * i, 0, 0})};
        run.trajectory.push_back(pose);
        run.frames.push_back({pose.stamp_s, false, 50});
        if (i % 2 == 0) run.keyframes.push_back(pose);
    }
    run.loops = {{3, 0}, {1, 4}};
    run.covisibility = {{0, 2}, {1, 3}, {2, 4}};
    return run;
}

TEST(Replay, showsWhatHadHappened) {
    const ReplayState state = replayAt(tenSeconds(), 106.5);
    EXPECT_EQ(state.poses, 7U);
    EXPECT_EQ(state.frames, 7U);
    EXPECT_EQ(state.keyframes, 4U);
    EXPECT_EQ(state.loops, 1U);
    EXPECT_EQ(state.covisibility, 2U);
}

TEST(Replay, beginsWithTheFirstFrameAndEndsWithEverything) {
    EXPECT_EQ(replayAt(tenSeconds(), 99).poses, 0U);
    EXPECT_EQ(replayAt(tenSeconds(), 100).keyframes, 1U);
    const ReplayState end = replayAt(tenSeconds(), 110);
    EXPECT_EQ(end.poses, 11U);
    EXPECT_EQ(end.loops, 2U);
    EXPECT_EQ(end.covisibility, 3U);
    EXPECT_EQ(timeSpan(tenSeconds()), std::make_pair(100.0, 110.0));
    EXPECT_EQ(timeSpan(RunData()), std::make_pair(0.0, 0.0));
}

TEST(PoseAt, isBetweenItsNeighbors) {
    const Trajectory trajectory = tenSeconds().trajectory;
    EXPECT_NEAR(poseNear(trajectory, 103.25)->t.x(), 3.25, 1e-12);
    EXPECT_DOUBLE_EQ(poseNear(trajectory, 90)->t.x(), 0);
    EXPECT_DOUBLE_EQ(poseNear(trajectory, 200)->t.x(), 10);
    EXPECT_FALSE(poseNear({}, 1));
}

}  // namespace
}  // namespace rgbd_graphslam
