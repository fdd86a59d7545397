#include "rgbd_graphslam/viewer/live_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace rgbd_graphslam {
namespace {

SE3 at(double x) {
    return {Eigen::Matrix3d::Identity(), {x, 0, 0}};
}

LiveFrame keyframe(int id, double stamp_s, double x) {
    LiveFrame frame;
    frame.stamp_s = stamp_s;
    frame.T_world_cam = at(x);
    frame.keyframe = id;
    frame.statistics = {{stamp_s, 5, 100, false}};
    RgbdImage image;
    image.color = cv::Mat(480, 640, CV_8UC3, cv::Scalar(10, 200, 10));
    image.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000));
    putImages(image, frame);
    return frame;
}

LiveMap mapWith(double x0, double x1) {
    LiveMap map;
    map.path = {{1, at(x0)}, {2, at(x1)}};
    map.keyframes = map.path;
    map.loops = {{1, 0}};
    map.covisibility = {{0, 1}};
    return map;
}

TEST(LiveRun, waitsForTheRun) {
    LiveRun live("/no/such/folder");
    EXPECT_FALSE(live.update());
    EXPECT_EQ(live.state(), LiveRun::State::Waiting);
}

TEST(LiveRun, aRunThatWasOverBeforeTheViewerWasReadyHasEnded) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("rgbd-live-run-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "summary.json") << "{}";
    const auto written = std::filesystem::last_write_time(folder / "summary.json");
    LiveRun ended(folder.string(), written - std::chrono::seconds(1));
    EXPECT_TRUE(ended.update());
    EXPECT_EQ(ended.state(), LiveRun::State::Ended);
    LiveRun waiting(folder.string(), written + std::chrono::seconds(1));  // an older run's result
    EXPECT_FALSE(waiting.update());
    EXPECT_EQ(waiting.state(), LiveRun::State::Waiting);
    std::filesystem::remove_all(folder);
}

TEST(LiveRun, framesExtendThePathAndThePlots) {
    LiveRun live("");
    live.take(keyframe(0, 1, 0));
    LiveFrame lost;
    lost.stamp_s = 2;
    lost.lost = true;
    lost.statistics = {{1.5, 6, 90, false}, {2, 7, 0, true}};
    live.take(lost);
    EXPECT_EQ(live.run().trajectory.size(), 1U);
    EXPECT_EQ(live.statistics().size(), 3U);
    EXPECT_TRUE(live.lastFrame()->lost);
    EXPECT_EQ(live.run().unplaced_s, std::vector<double>{2});
}

TEST(LiveRun, keyframesForTheMapAreNoPictures) {
    LiveRun live("");
    LiveFrame frame = keyframe(0, 1, 0);
    frame.is_picture = false;
    live.take(frame);
    EXPECT_FALSE(live.lastFrame());
    EXPECT_EQ(live.takeMovedClouds().size(), 1U);
    EXPECT_EQ(live.run().trajectory.size(), 1U);
}

TEST(LiveRun, betweenMapsOnlyTheTrajectoryGrows) {
    LiveRun live("");
    live.take(mapWith(0, 1));
    const std::size_t revision = live.revisions();
    live.take(keyframe(2, 3, 2));
    EXPECT_EQ(live.revisions(), revision);
    EXPECT_EQ(live.run().trajectory.size(), 3U);
    live.take(mapWith(0, 1.1));
    EXPECT_NE(live.revisions(), revision);
}

TEST(LiveRun, cloudsFollowTheirKeyframes) {
    LiveRun live("");
    live.take(keyframe(0, 1, 0));
    live.take(keyframe(1, 2, 1));
    const auto first = live.takeMovedClouds();
    ASSERT_EQ(first.size(), 2U);
    EXPECT_GT(first[0].second.size(), 1000U);
    EXPECT_TRUE(live.takeMovedClouds().empty());
    live.take(mapWith(0, 1.5));  // a loop has moved the second
    const auto moved = live.takeMovedClouds();
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_EQ(moved[0].first, 1U);
    EXPECT_NEAR(moved[0].second[0].position.x() - first[1].second[0].position.x(), 0.5, 1e-5);
    EXPECT_EQ(live.run().loops.size(), 1U);
    ASSERT_EQ(live.run().covisibility.size(), 1U);
    EXPECT_EQ(live.run().covisibility[0].to, 1);
    EXPECT_EQ(live.run().keyframes.size(), 2U);
}

TEST(LiveRun, keyframesWhoseImagesWereDroppedHaveNoCloud) {
    LiveRun live("");
    live.take(keyframe(1, 2, 1));
    live.take(mapWith(0, 1));
    const auto clouds = live.takeMovedClouds();
    ASSERT_EQ(clouds.size(), 1U);
    EXPECT_EQ(clouds[0].first, 1U);
}

}  // namespace
}  // namespace rgbd_graphslam
