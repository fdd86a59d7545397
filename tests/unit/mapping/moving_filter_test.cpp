#include "rgbd_graphslam/mapping/moving_filter.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "box_room.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

const Camera camera = smallCamera();

SE3 poseAt(int i) {
    return lookingAlong({-1.5, 0.02 * i, 1.2}, 0.01 * i, 0.2);
}

/** A person of 40 x 40 cm who walks through the view from right to left. */
Box walkerAt(int i) {
    const double y = -1.2 + 0.1 * i;
    return {{0.3, y, 0}, {0.7, y + 0.4, 1.7}, {90, 90, 90}};
}

/** Frames of 0.2 s each. */
RgbdImage frame(int i, bool with_walker) {
    BoxRoom room;
    if (with_walker) room.furniture.push_back(walkerAt(i));
    Noise noise;
    return render(room, camera, poseAt(i), 0.2 * i, &noise);
}

MovingFilter filterOf(bool with_walker) {
    MovingFilter filter(camera);
    for (int i = 0; i < 24; ++i) filter.add(frame(i, with_walker), 0.2 * i, poseAt(i), 0);
    return filter;
}

/** Readings of the walker, and of all else. */
struct Readings {
    int of_walker = 0, of_room = 0;
};

Readings readingsIn(const RgbdImage& image, int i) {
    const SE3 T = poseAt(i);
    Readings readings;
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const double z = image.depth_unit_m * image.depth.at<std::uint16_t>(v, u);
            if (z == 0) continue;
            const Eigen::Vector3d p = T * camera.unproject(u, v, z);
            // The floor at the walker's feet is no walker.
            const bool is_walker = walkerAt(i).holds(p, -0.05) && p.z() > 0.1;
            ++(is_walker ? readings.of_walker : readings.of_room);
        }
    }
    return readings;
}

TEST(MovingFilter, aWalkerLeavesHardlyAnyReadings) {
    const MovingFilter filter = filterOf(true);
    for (const int i : {6, 12, 18}) {
        const RgbdImage image = frame(i, true);
        const Readings before = readingsIn(image, i);
        ASSERT_GT(before.of_walker, 2000);
        const Readings after = readingsIn(filter.withoutMovers(image, 0.2 * i, poseAt(i), 0), i);
        EXPECT_LT(after.of_walker, 0.04 * before.of_walker) << i;
        EXPECT_GT(after.of_room, 0.97 * before.of_room) << i;
    }
}

TEST(MovingFilter, whereNothingMovesNothingIsLost) {
    const MovingFilter filter = filterOf(false);
    for (const int i : {0, 12, 23}) {
        const RgbdImage image = frame(i, false);
        const int before = cv::countNonZero(image.depth);
        const int after =
            cv::countNonZero(filter.withoutMovers(image, 0.2 * i, poseAt(i), 0).depth);
        EXPECT_GT(after, 0.999 * before) << i;
    }
}

TEST(MovingFilter, imagesOfAnotherSizeAreLeftAlone) {
    MovingFilter filter(camera);
    RgbdImage small;
    small.depth = cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000));
    filter.add(small, 0, {}, 0);
    EXPECT_EQ(filter.sights(), 0u);
    EXPECT_EQ(filter.withoutMovers(small, 0, {}, 0).depth.data, small.depth.data);
}

TEST(SightsOf, areTenASecondAndFewerInLongRecordings) {
    MapInputs inputs;
    for (int i = 0; i < 3000; ++i) inputs.trajectory.push_back({i / 30.0, {}});
    EXPECT_NEAR(static_cast<double>(sightsOf(inputs).size()), 1000, 10);
    for (auto& pose : inputs.trajectory) pose.stamp_s *= 30;
    EXPECT_LE(sightsOf(inputs).size(), 3300u);
    inputs.trajectory.clear();
    inputs.keyframes = {{1, {}}, {2, {}}};
    EXPECT_EQ(sightsOf(inputs).size(), 2u);
}

}  // namespace
}  // namespace rgbd_graphslam
