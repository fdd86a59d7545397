#include "rgbd_graphslam/slam/dense_alignment.h"

#include <gtest/gtest.h>

#include <random>

#include "dense_room.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_room_reference = lookingIntoTheCorner(0, {0, 0, 0});

double errorOf(const std::optional<DenseAlignment>& alignment, const SE3& T_room_view) {
    const SE3 truth = T_room_reference.inverse() * T_room_view;
    return alignment ? alignment->T_reference_view.minus(truth).norm() : 1e9;
}

TEST(DenseAlignment, findsTheMotionOfSomeFramesAtOnce) {
    const DenseRoom room;
    const DenseView reference = room.view(T_room_reference);
    for (int i = 1; i <= 6; ++i) {
        const SE3 T_room_view = lookingIntoTheCorner(0.02 * i, {0.015 * i, -0.01 * i, 0.02 * i});
        const auto alignment = alignDensely(reference, room.view(T_room_view), SE3());
        EXPECT_LT(errorOf(alignment, T_room_view), 0.01) << i;
        EXPECT_GT(alignment ? alignment->overlap : 0, 0.6) << i;
    }
}

TEST(DenseAlignment, lightMayChange) {
    const DenseRoom room;
    const SE3 T_room_view = lookingIntoTheCorner(0.03, {0.03, 0, 0.02});
    DenseView view = room.view(T_room_view);
    for (float& gray : view.gray) gray = 10 + 0.4f * gray;
    EXPECT_LT(errorOf(alignDensely(room.view(T_room_reference), view, SE3()), T_room_view), 0.01);
}

TEST(DenseAlignment, surfacesAloneDoInACorner) {
    const DenseRoom room;
    const SE3 T_room_view = lookingIntoTheCorner(0.03, {0.03, 0, 0.02});
    DenseView view = room.view(T_room_view);
    view.gray.assign(view.gray.size(), 0);
    EXPECT_LT(errorOf(alignDensely(room.view(T_room_reference), view, SE3()), T_room_view), 0.02);
}

TEST(DenseAlignment, aBareWallSaysTooLittle) {
    const DenseRoom room;
    const SE3 T_room_wall(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.8));
    DenseView wall = room.view(T_room_wall);
    wall.gray.assign(wall.gray.size(), 90);
    EXPECT_FALSE(alignDensely(wall, wall, SE3()));
}

/** Each reading of depth tilts the surface a little, as if it had structure. */
TEST(DenseAlignment, noiseOfSomethingFlatHoldsNothing) {
    std::mt19937_64 random(1);
    const auto flat = [&] {
        DenseView view;
        view.camera = Camera().shrunk(8);
        for (int i = 0; i < view.camera.width * view.camera.height; ++i) {
            view.gray.push_back(110);
            view.depth_m.push_back(1 + 0.004f * (random() % 1001 / 500.f - 1));
        }
        return view;
    };
    EXPECT_FALSE(alignDensely(flat(), flat(), SE3()));
}

TEST(DenseAlignment, grayValuesHoldWhereAWallIsFlat) {
    const DenseRoom room;
    const SE3 T_room_wall(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.8));
    const SE3 moved(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.03, 0.02, 0.8));
    const auto alignment = alignDensely(room.view(T_room_wall), room.view(moved), SE3());
    ASSERT_TRUE(alignment);
    EXPECT_LT((alignment->T_reference_view.t - Eigen::Vector3d(0.03, 0.02, 0)).norm(), 0.01);
}

TEST(DenseAlignment, anotherPlaceIsRefused) {
    const DenseRoom room;
    const DenseView reference = room.view(T_room_reference);
    for (const double turn : {1.2, 2.0, 3.1, 4.5}) {
        EXPECT_FALSE(
            alignDensely(reference, room.view(lookingIntoTheCorner(turn, {0, 0, 0})), SE3()))
            << turn;
    }
    DenseView covered = reference;
    covered.depth_m.assign(covered.depth_m.size(), 0);
    EXPECT_FALSE(alignDensely(reference, covered, SE3()));
    EXPECT_FALSE(alignDensely(covered, reference, SE3()));
}

}  // namespace
}  // namespace rgbd_graphslam
