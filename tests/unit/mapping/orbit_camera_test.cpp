#include "rgbd_graphslam/mapping/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

const Eigen::Vector2i size_px(640, 480);
const Eigen::Vector2d center_px(320, 240);

OrbitCamera fromNorthWest() {
    OrbitCamera camera;
    camera.target = {1, 2, 0.5};
    camera.azimuth_rad = 2.3;
    camera.elevation_rad = 0.6;
    camera.distance_m = 4;
    return camera;
}

TEST(OrbitCamera, targetIsInTheMiddleAtItsDistance) {
    const OrbitCamera camera = fromNorthWest();
    const Eigen::Vector3d seen = camera.project(camera.target, size_px);
    EXPECT_NEAR(seen.x(), 320, 1e-9);
    EXPECT_NEAR(seen.y(), 240, 1e-9);
    EXPECT_NEAR(seen.z(), 4, 1e-9);
}

TEST(OrbitCamera, upIsUpAndLeftIsLeft) {
    OrbitCamera camera = fromNorthWest();
    const auto above = camera.project(camera.target + Eigen::Vector3d(0, 0, 0.2), size_px);
    EXPECT_LT(above.y(), 230);
    EXPECT_NEAR(above.x(), 320, 1e-9);
    camera.azimuth_rad = 0;  // from +x: +y is on the right
    const auto beside = camera.project(camera.target + Eigen::Vector3d(0, 0.2, 0), size_px);
    EXPECT_GT(beside.x(), 330);
}

TEST(OrbitCamera, unprojectUndoesProject) {
    const OrbitCamera camera = fromNorthWest();
    const Eigen::Vector3d p(1.4, 1.7, 0.9);
    const Eigen::Vector4d clip = camera.clipFromWorld(size_px) * p.homogeneous();
    const double depth = 0.5 * (1 + clip.z() / clip.w());
    const Eigen::Vector3d seen = camera.project(p, size_px);
    EXPECT_LT((camera.unproject(seen.head<2>(), depth, size_px) - p).norm(), 1e-6);
}

TEST(OrbitCamera, whatIsBehindTheEyeHasNoPositiveDistance) {
    const OrbitCamera camera = fromNorthWest();
    EXPECT_LT(camera.project(2 * camera.eye() - camera.target, size_px).z(), 0);
}

TEST(OrbitCamera, panKeepsTheTargetUnderTheMouse) {
    OrbitCamera camera = fromNorthWest();
    const Eigen::Vector3d grabbed = camera.target;
    camera.pan({50, -30}, size_px.y());
    const Eigen::Vector3d seen = camera.project(grabbed, size_px);
    EXPECT_NEAR(seen.x(), 370, 1e-9);
    EXPECT_NEAR(seen.y(), 210, 1e-9);
}

TEST(OrbitCamera, zoomKeepsWhatIsUnderThePointer) {
    OrbitCamera camera = fromNorthWest();
    const Eigen::Vector2d pointer(450, 100);
    // Depth of the plane through the target, in which the world stays put.
    const auto depthOfTarget = [&] {
        const Eigen::Vector4d clip = camera.clipFromWorld(size_px) * camera.target.homogeneous();
        return 0.5 * (1 + clip.z() / clip.w());
    };
    const Eigen::Vector3d before = camera.unproject(pointer, depthOfTarget(), size_px);
    camera.zoom(0.5, pointer, size_px);
    EXPECT_DOUBLE_EQ(camera.distance_m, 2);
    EXPECT_LT((camera.unproject(pointer, depthOfTarget(), size_px) - before).norm(), 1e-6);
}

TEST(OrbitCamera, turnsNoFurtherThanStraightUpAndDown) {
    OrbitCamera camera = fromNorthWest();
    camera.orbit({0, 1e6});
    EXPECT_DOUBLE_EQ(camera.elevation_rad, M_PI / 2);
    EXPECT_TRUE(camera.clipFromWorld(size_px).allFinite());
    camera.orbit({0, -1e6});
    EXPECT_DOUBLE_EQ(camera.elevation_rad, -M_PI / 2);
}

TEST(OrbitCamera, fromAboveYPointsUp) {
    OrbitCamera camera = fromNorthWest();
    camera.lookDown();
    const auto north = camera.project(camera.target + Eigen::Vector3d(0, 1, 0), size_px);
    const auto east = camera.project(camera.target + Eigen::Vector3d(1, 0, 0), size_px);
    EXPECT_LT(north.y(), 200);
    EXPECT_NEAR(north.x(), 320, 1e-6);
    EXPECT_GT(east.x(), 360);
}

TEST(OrbitCamera, framedBoxIsSeenWholeAndFillsTheView) {
    OrbitCamera camera = fromNorthWest();
    for (const Eigen::Vector3d& half :
         {Eigen::Vector3d(5, 1, 1), Eigen::Vector3d(0.2, 0.2, 3), Eigen::Vector3d(40, 60, 2)}) {
        const Eigen::AlignedBox3d box(Eigen::Vector3d(3, -1, 1) - half,
                                      Eigen::Vector3d(3, -1, 1) + half);
        camera.frame(box, size_px);
        double farthest = 0;
        for (int i = 0; i < 8; ++i) {
            const auto corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
            const Eigen::Vector3d seen = camera.project(corner, size_px);
            ASSERT_GT(seen.z(), 0);
            const Eigen::Vector2d from_center = (seen.head<2>() - center_px).cwiseAbs();
            farthest = std::max({farthest, from_center.x() / 320, from_center.y() / 240});
        }
        EXPECT_LE(farthest, 1);
        EXPECT_GT(farthest, 0.8);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
