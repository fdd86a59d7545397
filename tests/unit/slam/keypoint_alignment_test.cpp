#include "../../../libs/slam/src/keypoint_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr int columns = 8, rows = 6;
constexpr double distance_m = 2;

double waves(double x, double y) {
    return 120 + 40 * std::sin(0.9 * x + 0.3 * y) + 30 * std::cos(0.4 * x - 0.8 * y + 1);
}

Patch patchAt(double u, double v) {
    Patch patch;
    for (int j = 0; j < Patch::side; ++j) {
        for (int i = 0; i < Patch::side; ++i) {
            patch.gray[Patch::side * j + i] = static_cast<std::uint8_t>(
                std::lround(waves(u + i - Patch::center, v + j - Patch::center)));
        }
    }
    return patch;
}

/** A wall of waves straight ahead: keypoint i shows wave pattern i, `moved_px` to the right of
 *  where the first camera saw it and `wrong_px` from where it says. */
Frame wallFrame(const Camera& camera, double moved_px, double wrong_px) {
    Frame frame;
    for (int i = 0; i < columns * rows; ++i) {
        const double u = 60 + 70 * (i % columns), v = 60 + 70 * (i / columns);
        const Eigen::Vector2d said = camera.rectify({u + moved_px + wrong_px, v});
        Keypoint k;
        k.u = static_cast<float>(said.x());
        k.v = static_cast<float>(said.y());
        k.depth_m = distance_m;
        frame.keypoints.push_back(k);
        frame.patches.push_back(patchAt(100 * i + wrong_px, 0));
    }
    frame.descriptors.resize(frame.keypoints.size());
    return frame;
}

SlamMap mapOf(const Frame& frame, const Camera& camera) {
    SlamMap map(1.25, 6);
    map.addKeyframe(frame, SE3());
    for (int i = 0; i < columns * rows; ++i) {
        const Keypoint& k = frame.keypoints[i];
        map.addLandmark(camera.rectified().unproject(k.u, k.v, k.depth_m), 0, i);
    }
    return map;
}

std::vector<int> allLandmarks() {
    std::vector<int> landmarks(columns * rows);
    for (int i = 0; i < columns * rows; ++i) landmarks[i] = i;
    return landmarks;
}

/** Of keypoints that are 0.7 px off, after alignment. */
double worstErrorAfterAlignment(const Camera& camera) {
    const Frame exact = wallFrame(camera, 3, 0);
    Frame frame = wallFrame(camera, 3, 0.7);
    alignKeypoints(frame, allLandmarks(), SE3(), RigCameras(camera),
                   mapOf(wallFrame(camera, 0, 0), camera));
    double worst = 0;
    for (int i = 0; i < columns * rows; ++i) {
        EXPECT_TRUE(frame.keypoints[i].aligned) << "keypoint " << i;
        worst = std::max<double>(worst, std::hypot(frame.keypoints[i].u - exact.keypoints[i].u,
                                                   frame.keypoints[i].v - exact.keypoints[i].v));
    }
    return worst;
}

TEST(KeypointAlignment, takesKeypointsToTheirLandmarks) {
    EXPECT_LT(worstErrorAfterAlignment(Camera{}), 0.1);
}

/** The camera turns about its axis: what its pixels show follows from the poses alone. */
TEST(KeypointAlignment, heedsTheRollOfTheCamera) {
    Intrinsics camera;
    camera.cx = 320;
    camera.cy = 240;
    Frame first;
    first.keypoints.push_back({320, 240, distance_m, 0, 0});
    first.descriptors.resize(1);
    first.patches.push_back(patchAt(0, 0));
    SlamMap map(1.25, 6);
    map.addKeyframe(first, SE3());
    map.addLandmark({0, 0, distance_m}, 0, 0);
    for (const double roll : {-0.35, -0.05, 0.05, 0.35}) {
        const SE3 T_cam_world(rotationExp({0, 0, roll}), Eigen::Vector3d::Zero());
        Frame frame = first;
        frame.keypoints[0].u += 0.6F;
        for (int j = 0; j < Patch::side; ++j) {
            for (int i = 0; i < Patch::side; ++i) {
                const Eigen::Vector3d seen(i - Patch::center + 0.6, j - Patch::center, camera.fx);
                const Eigen::Vector3d p = T_cam_world.R.transpose() * seen;
                frame.patches[0].gray[Patch::side * j + i] =
                    static_cast<std::uint8_t>(std::lround(waves(p.x(), p.y())));
            }
        }
        alignKeypoints(frame, {0}, T_cam_world, RigCameras(camera), map);
        EXPECT_TRUE(frame.keypoints[0].aligned) << "roll " << roll;
        EXPECT_NEAR(frame.keypoints[0].u, 320, 0.1) << "roll " << roll;
        EXPECT_NEAR(frame.keypoints[0].v, 240, 0.1) << "roll " << roll;
    }
}

TEST(KeypointAlignment, heedsTheLens) {
    Intrinsics camera;
    camera.lens = BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
    EXPECT_LT(worstErrorAfterAlignment(camera), 0.1);
}

TEST(KeypointAlignment, againChangesNothingMore) {
    const Camera camera;
    const SlamMap map = mapOf(wallFrame(camera, 0, 0), camera);
    Frame once = wallFrame(camera, 3, 0.7);
    alignKeypoints(once, allLandmarks(), SE3(), RigCameras(camera), map);
    Frame twice = once;
    alignKeypoints(twice, allLandmarks(), SE3(), RigCameras(camera), map);
    for (int i = 0; i < columns * rows; ++i) {
        EXPECT_NEAR(twice.keypoints[i].u, once.keypoints[i].u, 0.02) << "keypoint " << i;
        EXPECT_TRUE(twice.keypoints[i].aligned);
    }
}

TEST(KeypointAlignment, leavesWhatShowsNoLandmarkOrHasNoPatch) {
    const Camera camera;
    const SlamMap map = mapOf(wallFrame(camera, 0, 0), camera);
    Frame frame = wallFrame(camera, 3, 0.7);
    const std::vector<Keypoint> before = frame.keypoints;
    alignKeypoints(frame, std::vector<int>(before.size(), no_landmark), SE3(), RigCameras(camera),
                   map);
    EXPECT_EQ(frame.keypoints[5].u, before[5].u);
    EXPECT_FALSE(frame.keypoints[5].aligned);
    frame.patches.clear();
    alignKeypoints(frame, allLandmarks(), SE3(), RigCameras(camera), map);
    EXPECT_EQ(frame.keypoints[5].u, before[5].u);
}

}  // namespace
}  // namespace rgbd_graphslam
