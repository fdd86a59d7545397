#include "rgbd_graphslam/mapping/framing.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/mapping/orbit_camera.h"

namespace rgbd_graphslam {
namespace {

/** Poses along x that look along z. */
Trajectory lookingAlongZ(int count, double step_m = 0.1) {
    Trajectory poses;
    for (int i = 0; i < count; ++i)
        poses.push_back({0.1 * i, {Eigen::Matrix3d::Identity(), {step_m * i, 0, 0}}});
    return poses;
}

/** A square of 2 m around the axis, at a distance along z. */
PointMap wall(float z, int a_side = 50) {
    PointMap points;
    for (int i = 0; i < a_side; ++i) {
        for (int j = 0; j < a_side; ++j) {
            const float step = 2.f / static_cast<float>(a_side);
            points.push_back(
                {{step * static_cast<float>(i) - 1, step * static_cast<float>(j) - 1, z}, {}});
        }
    }
    return points;
}

template <class... Arguments>
Eigen::AlignedBox3d boxOf(const Arguments&... arguments) {
    return framingOf(arguments...).box;
}

TEST(FramingBox, leavesStraysOut) {
    PointMap points = wall(3);
    const Eigen::AlignedBox3d without = boxOf(points, Trajectory(), Trajectory());
    for (int i = 0; i < 40; ++i) points.push_back({{900, 900, 900}, {}});  // under 2 %
    const Eigen::AlignedBox3d box = boxOf(points, Trajectory(), Trajectory());
    EXPECT_LT((box.max() - without.max()).norm(), 0.1);
    EXPECT_GT(box.sizes().x(), 1.8);
}

TEST(FramingBox, countsWhatManyViewsSaw) {
    // A wall that ten cameras see, and as many points far behind them that none looks at.
    PointMap points = wall(3);
    for (MapPoint point : wall(-40)) points.push_back(point);
    EXPECT_LT(boxOf(points, Trajectory(), Trajectory()).min().z(), -30);
    EXPECT_GT(boxOf(points, lookingAlongZ(10), Trajectory()).min().z(), 0);
}

TEST(FramingBox, aFarWallCountsForLessThanItsPoints) {
    PointMap points = wall(2);
    for (MapPoint point : wall(60)) {  // as many points, spread over what a camera sees there
        point.position.head<2>() *= 15;
        points.push_back(point);
    }
    EXPECT_GT(boxOf(points, Trajectory(), Trajectory()).max().z(), 50);
    EXPECT_LT(boxOf(points, lookingAlongZ(3), Trajectory()).max().z(), 10);
}

TEST(FramingBox, holdsThePathAndWhatIsBelowTheCut) {
    const Eigen::AlignedBox3d box = boxOf(wall(1), Trajectory(), lookingAlongZ(100, 0.2), 2);
    EXPECT_GT(box.max().x(), 19);
    EXPECT_TRUE(boxOf(wall(3), Trajectory(), Trajectory(), 2).isEmpty());
    EXPECT_TRUE(framingOf({}, {}, {}).box.isEmpty());
}

TEST(FramingOf, fillsTheView) {
    const Framing framing = framingOf(wall(1), {}, lookingAlongZ(10, 0.05));
    for (const Eigen::Vector3d& p : framing.points) EXPECT_TRUE(framing.box.contains(p));
    OrbitCamera camera;
    const Eigen::Vector2i size_px(800, 500);
    camera.frame(framing.points, size_px, {0.5, 0.8});
    Eigen::AlignedBox2d seen;
    for (const Eigen::Vector3d& p : framing.points)
        seen.extend(camera.project(p, size_px).head<2>());
    EXPECT_LT((seen.center() - Eigen::Vector2d(400, 250)).norm(), 10);
    const Eigen::Array2d filled = seen.sizes().array() / Eigen::Array2d(400, 400);
    EXPECT_LT(filled.maxCoeff(), 1);
    EXPECT_GT(filled.maxCoeff(), 0.85);
}

TEST(CeilingCut, isAboveTheCamera) {
    EXPECT_DOUBLE_EQ(ceilingCut({}), 2);
    EXPECT_DOUBLE_EQ(ceilingCut({{0, {Eigen::Matrix3d::Identity(), {0, 0, 2.5}}}}), 2.6);
}

TEST(CeilingCut, isNotWhereUpIsAGuess) {
    MapInputs inputs;
    EXPECT_DOUBLE_EQ(pictureCeiling(inputs), 2);
    inputs.up_is_guessed = true;
    EXPECT_TRUE(std::isinf(pictureCeiling(inputs)));
}

TEST(SparseKeyframes, keepOneOfManyInAPlace) {
    EXPECT_EQ(sparseKeyframes(lookingAlongZ(101, 0.01), 0.195).size(), 6U);  // 1 m
    EXPECT_EQ(sparseKeyframes(lookingAlongZ(10, 0.3), 0.2).size(), 10U);
    EXPECT_TRUE(sparseKeyframes({}, 0.2).empty());
}

TEST(SparseKeyframes, keepThoseThatLookElsewhere) {
    Trajectory turning;
    for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d turn(0, i * M_PI / 2, 0);
        turning.push_back({0.1 * i, {rotationExp(turn), Eigen::Vector3d::Zero()}});
        turning.push_back(turning.back());
    }
    EXPECT_EQ(sparseKeyframes(turning, 0.2), (std::vector<std::size_t>{0, 2, 4, 6}));
}

}  // namespace
}  // namespace rgbd_graphslam
