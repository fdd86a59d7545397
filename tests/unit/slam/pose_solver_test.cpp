#include "rgbd_graphslam/slam/pose_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "rgbd_graphslam/slam/ransac_alignment.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

struct Scene {
    Camera camera;
    SE3 T_cam_world{rotationExp({0.1, -0.3, 0.05}), {0.2, -0.1, 0.4}};
    std::vector<PointMatch> matches;
    std::vector<Eigen::Vector3d> points_cam;
};

/** Matches with the noise that the sensor model promises.
 *  \param wrong share of matches with a random pixel */
Scene makeScene(SyntheticWorld& random, int matches, double wrong, double noise = 1) {
    Scene scene;
    const SensorOptions sensor;
    while (static_cast<int>(scene.matches.size()) < matches) {
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-0.8, 0.8),
                                random.uniform(1, 4));
        const Eigen::Vector2d pixel = scene.camera.project(p);
        if (!scene.camera.contains(pixel)) continue;
        const double z = p.z() + noise * sensor.depth_noise.sigma(p.z()) * random.gauss();
        Keypoint k{
            static_cast<float>(pixel.x() + noise * sensor.keypoint_sigma_px * random.gauss()),
            static_cast<float>(pixel.y() + noise * sensor.keypoint_sigma_px * random.gauss()),
            static_cast<float>(z), 0, 0};
        if (random.uniform(0, 1) < wrong) k.u = static_cast<float>(random.uniform(0, 639));
        scene.matches.push_back({scene.T_cam_world.inverse() * p, measurementOf(k, 1, sensor)});
        scene.points_cam.push_back(scene.camera.unproject(k.u, k.v, k.depth_m));
    }
    return scene;
}

TEST(PoseSolver, findsTheExactPoseWithoutNoise) {
    SyntheticWorld random(1);
    const Scene scene = makeScene(random, 100, 0, 0);
    const SE3 start =
        scene.T_cam_world.retract((Vector6d() << 0.05, -0.05, 0.05, 0.03, 0.03, -0.03).finished());
    const auto solution = solvePose(scene.camera, scene.matches, start);
    EXPECT_LT(solution.T_cam_world.minus(scene.T_cam_world).norm(), 1e-5);
    EXPECT_EQ(solution.inliers, 100);
}

TEST(PoseSolver, survivesThirtyPercentWrongMatches) {
    SyntheticWorld random(1, 5);
    const Scene scene = makeScene(random, 300, 0.3);
    const SE3 start =
        scene.T_cam_world.retract((Vector6d() << 0.02, -0.02, 0.02, 0.02, 0.01, -0.01).finished());
    const auto solution = solvePose(scene.camera, scene.matches, start);
    EXPECT_LT(solution.T_cam_world.minus(scene.T_cam_world).norm(), 0.004);
    EXPECT_GT(solution.inliers, 170);
    EXPECT_LT(solution.inliers, 235);
}

/** The first matches walk 6 cm to the right together. */
void walk(Scene& scene, std::size_t matches, double trust) {
    for (std::size_t i = 0; i < matches; ++i) {
        scene.matches[i].position.x() -= 0.06;
        scene.matches[i].trust = trust;
    }
}

TEST(PoseSolver, staysWithTheRoomWhenAThirdOfTheMatchesWalk) {
    SyntheticWorld random(1, 3);
    Scene scene = makeScene(random, 300, 0);
    walk(scene, 100, 1);
    const auto error = [&](PoseKernel kernel) {
        const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world, kernel);
        return solution.T_cam_world.minus(scene.T_cam_world).norm();
    };
    EXPECT_LT(error(PoseKernel::GemanMcClure), 0.004);
}

TEST(PoseSolver, followsTheTrustedMinority) {
    SyntheticWorld random(1, 3);
    Scene scene = makeScene(random, 300, 0);
    walk(scene, 180, 1);
    const auto misled = solvePose(scene.camera, scene.matches, scene.T_cam_world);
    EXPECT_GT(misled.T_cam_world.minus(scene.T_cam_world).norm(), 0.03);
    scene = makeScene(random, 300, 0);
    walk(scene, 180, 0.1);
    const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world);
    EXPECT_LT(solution.T_cam_world.minus(scene.T_cam_world).norm(), 0.006);
    EXPECT_LT(solution.inliers, 125);
}

TEST(PoseSolver, informationIsTheInverseOfTheMonteCarloCovariance) {
    constexpr int trials = 400;
    SyntheticWorld random(1, 9);
    Matrix6d covariance = Matrix6d::Zero(), predicted = Matrix6d::Zero();
    for (int t = 0; t < trials; ++t) {
        const Scene scene = makeScene(random, 150, 0);
        const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world);
        const Vector6d error = solution.T_cam_world.minus(scene.T_cam_world);
        covariance += error * error.transpose() / trials;
        predicted += solution.information.inverse() / trials;
    }
    for (int i = 0; i < 6; ++i) {
        const double ratio = std::sqrt(covariance(i, i) / predicted(i, i));
        EXPECT_GT(ratio, 0.85) << "axis " << i;
        EXPECT_LT(ratio, 1.25) << "axis " << i;
    }
}

TEST(PoseSolver, withoutMatchesKeepsThePose) {
    const auto solution = solvePose(Camera{}, {}, SE3());
    EXPECT_EQ(solution.inliers, 0);
    EXPECT_TRUE(solution.T_cam_world.t.allFinite());
}

TEST(RansacAlignment, findsTheMotionAmongTwoThirdsWrongPairs) {
    SyntheticWorld random(1, 3);
    const Scene scene = makeScene(random, 150, 0.66);
    const auto aligned = alignRobustly(scene.camera, scene.matches, scene.points_cam, 500, 1);
    ASSERT_TRUE(aligned);
    EXPECT_LT(aligned->T_cam_world.minus(scene.T_cam_world).norm(), 0.15);
    EXPECT_GT(aligned->inliers, 25);
}

TEST(RansacAlignment, isSilentWithTooFewPairs) {
    EXPECT_FALSE(alignRobustly(Camera{}, {}, {}, 100, 1));
}

}  // namespace
}  // namespace rgbd_graphslam
