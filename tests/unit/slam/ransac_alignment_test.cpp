#include "rgbd_graphslam/slam/ransac_alignment.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

constexpr int pairs = 150;

struct Scene {
    Camera camera;
    SE3 T_cam_world{rotationExp({0.1, -0.3, 0.05}), {0.2, -0.1, 0.4}};
    std::vector<PointMatch> matches;
    std::vector<Eigen::Vector3d> points_cam;
};

/** Matches with the noise that the sensor model promises, two thirds of them with a random pixel.
 */
Scene makeScene(SyntheticWorld& random) {
    Scene scene;
    const SensorOptions sensor;
    while (static_cast<int>(scene.matches.size()) < pairs) {
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-0.8, 0.8),
                                random.uniform(1, 4));
        const Eigen::Vector2d pixel = scene.camera.project(p);
        if (!scene.camera.contains(pixel)) continue;
        const double z = p.z() + sensor.depth_noise.sigma(p.z()) * random.gauss();
        Keypoint k{static_cast<float>(pixel.x() + sensor.keypoint_sigma_px * random.gauss()),
                   static_cast<float>(pixel.y() + sensor.keypoint_sigma_px * random.gauss()),
                   static_cast<float>(z), 0, 0};
        if (random.uniform(0, 1) < 0.66) k.u = static_cast<float>(random.uniform(0, 639));
        scene.matches.push_back({scene.T_cam_world.inverse() * p, measurementOf(k, 1, sensor)});
        scene.points_cam.push_back(scene.camera.unproject(k.u, k.v, k.depth_m));
    }
    return scene;
}

TEST(RansacAlignment, findsTheMotionAmongTwoThirdsWrongPairs) {
    SyntheticWorld random(1, 3);
    const Scene scene = makeScene(random);
    const auto aligned =
        alignRobustly(RigCameras(scene.camera), scene.matches, scene.points_cam, 500, 1);
    ASSERT_TRUE(aligned);
    EXPECT_LT(aligned->T_cam_world.minus(scene.T_cam_world).norm(), 0.15);
    EXPECT_GT(aligned->inliers, 25);
}

TEST(RansacAlignment, isSilentWithTooFewPairs) {
    EXPECT_FALSE(alignRobustly(RigCameras(Camera{}), {}, {}, 100, 1));
}

}  // namespace
}  // namespace rgbd_graphslam
