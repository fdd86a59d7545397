#include "rgbd_graphslam/slam/dense_odometry.h"

#include <gtest/gtest.h>

#include "dense_room.h"

namespace rgbd_graphslam {
namespace {

constexpr double period_s = 1.0 / 30;

/** A hand-held sweep along the corner of the room. */
SE3 sweep(int i) {
    return lookingIntoTheCorner(0.01 * i, {0.01 * i, 0.1 * std::sin(0.1 * i), -0.005 * i});
}

Frame frameAt(int i, DenseView view) {
    Frame frame;
    frame.stamp_s = 1 + period_s * i;
    frame.view = std::async(std::launch::deferred, [view] { return view; }).share();
    return frame;
}

DenseView covered() {
    DenseView view = DenseRoom().view(sweep(0));
    view.gray.assign(view.gray.size(), 0);
    view.depth_m.assign(view.depth_m.size(), 0);
    return view;
}

TEST(DenseOdometry, followsWholeImagesWithLittleDrift) {
    const DenseRoom room;
    DenseOdometry tracker;
    tracker.restart(frameAt(0, room.view(sweep(0))), SE3());
    SE3 T_first_cam;
    for (int i = 1; i <= 40; ++i) {
        const auto T_last_cam = tracker.follow(frameAt(i, room.view(sweep(i))));
        ASSERT_TRUE(T_last_cam) << i;
        T_first_cam = T_first_cam * *T_last_cam;
        EXPECT_LT(T_first_cam.minus(sweep(0).inverse() * sweep(i)).norm(), 0.03) << i;
    }
}

TEST(DenseOdometry, bridgesAShortDarknessByComparingWithTheLastImageSeen) {
    const DenseRoom room;
    DenseOdometry tracker;
    tracker.restart(frameAt(0, room.view(sweep(0))), SE3());
    for (int i = 1; i <= 5; ++i) EXPECT_FALSE(tracker.follow(frameAt(i, covered())));
    const auto T_last_cam = tracker.follow(frameAt(6, room.view(sweep(6))));
    ASSERT_TRUE(T_last_cam);
    EXPECT_LT(T_last_cam->minus(sweep(0).inverse() * sweep(6)).norm(), 0.02);
    EXPECT_FALSE(tracker.follow(frameAt(60, room.view(sweep(7)))));  // it may be anywhere by now
}

TEST(DenseOdometry, odometryCarriesThroughTheDark) {
    DenseOdometry tracker;
    const auto dark = [&](int i) {
        Frame frame = frameAt(i, covered());
        frame.reckoning.T_odometry_cam = SE3(rotationExp({0, 0, 2}), {5, 5, 0}) * sweep(i);
        return frame;
    };
    tracker.restart(dark(0), SE3());
    for (int i = 1; i <= 90; ++i) {
        const auto T_last_cam = tracker.follow(dark(i));
        ASSERT_TRUE(T_last_cam);
        EXPECT_LT(T_last_cam->minus(sweep(i - 1).inverse() * sweep(i)).norm(), 1e-9);
    }
}

TEST(DenseOdometry, gyroscopeServesForMoments) {
    DenseOdometry tracker;
    const auto dark = [&](int i) {
        Frame frame = frameAt(i, covered());
        frame.reckoning.R_gyroscope_cam = sweep(i).R;
        return frame;
    };
    tracker.restart(dark(0), SE3());
    for (int i = 1; i < 9; ++i) {
        const auto T_last_cam = tracker.follow(dark(i));
        ASSERT_TRUE(T_last_cam) << i;
        EXPECT_LT((T_last_cam->R - sweep(i - 1).R.transpose() * sweep(i).R).norm(), 1e-9);
    }
    for (int i = 11; i < 20; ++i) EXPECT_FALSE(tracker.follow(dark(i))) << i;
}

}  // namespace
}  // namespace rgbd_graphslam
