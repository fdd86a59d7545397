#include "rgbd_graphslam/estimation/pose_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "measurements.h"

namespace rgbd_graphslam {
namespace {

struct Scene {
    Camera camera;
    SE3 T_cam_world{rotationExp({0.1, -0.3, 0.05}), {0.2, -0.1, 0.4}};
    std::vector<PointMatch> matches;
};

/** Matches with the noise that their weights promise.
 *  \param wrong share of matches with a random pixel */
Scene makeScene(RandomInputs& random, int matches, double wrong, double noise = 1) {
    Scene scene;
    while (static_cast<int>(scene.matches.size()) < matches) {
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-0.8, 0.8),
                                random.uniform(1, 4));
        if (!scene.camera.contains(scene.camera.project(p))) continue;
        Measurement m = measurementOf(p, scene.camera, random, noise);
        if (random.uniform(0, 1) < wrong) m.u = random.uniform(0, 639);
        scene.matches.push_back({scene.T_cam_world.inverse() * p, m});
    }
    return scene;
}

TEST(PoseSolver, findsTheExactPoseWithoutNoise) {
    RandomInputs random(1);
    const Scene scene = makeScene(random, 100, 0, 0);
    const SE3 start =
        scene.T_cam_world.retract((Vector6d() << 0.05, -0.05, 0.05, 0.03, 0.03, -0.03).finished());
    const auto solution = solvePose(scene.camera, scene.matches, start);
    EXPECT_LT(solution.T_body_world.minus(scene.T_cam_world).norm(), 1e-5);
    EXPECT_EQ(solution.inliers, 100);
}

TEST(PoseSolver, survivesThirtyPercentWrongMatches) {
    RandomInputs random(5);
    const Scene scene = makeScene(random, 300, 0.3);
    const SE3 start =
        scene.T_cam_world.retract((Vector6d() << 0.02, -0.02, 0.02, 0.02, 0.01, -0.01).finished());
    const auto solution = solvePose(scene.camera, scene.matches, start);
    EXPECT_LT(solution.T_body_world.minus(scene.T_cam_world).norm(), 0.004);
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
    RandomInputs random(3);
    Scene scene = makeScene(random, 300, 0);
    walk(scene, 100, 1);
    const auto error = [&](KernelShape kernel) {
        const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world, kernel);
        return solution.T_body_world.minus(scene.T_cam_world).norm();
    };
    EXPECT_LT(error(KernelShape::GemanMcClure), 0.004);
}

TEST(PoseSolver, followsTheTrustedMinority) {
    RandomInputs random(3);
    Scene scene = makeScene(random, 300, 0);
    walk(scene, 180, 1);
    const auto misled = solvePose(scene.camera, scene.matches, scene.T_cam_world);
    EXPECT_GT(misled.T_body_world.minus(scene.T_cam_world).norm(), 0.03);
    scene = makeScene(random, 300, 0);
    walk(scene, 180, 0.1);
    const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world);
    EXPECT_LT(solution.T_body_world.minus(scene.T_cam_world).norm(), 0.006);
    EXPECT_LT(solution.inliers, 125);
}

TEST(PoseSolver, informationIsTheInverseOfTheMonteCarloCovariance) {
    constexpr int trials = 400;
    RandomInputs random(9);
    Matrix6d covariance = Matrix6d::Zero(), predicted = Matrix6d::Zero();
    for (int t = 0; t < trials; ++t) {
        const Scene scene = makeScene(random, 150, 0);
        const auto solution = solvePose(scene.camera, scene.matches, scene.T_cam_world);
        const Vector6d error = solution.T_body_world.minus(scene.T_cam_world);
        covariance += error * error.transpose() / trials;
        predicted += solution.information.inverse() / trials;
    }
    for (int i = 0; i < 6; ++i) {
        const double ratio = std::sqrt(covariance(i, i) / predicted(i, i));
        EXPECT_GT(ratio, 0.85) << "axis " << i;
        EXPECT_LT(ratio, 1.25) << "axis " << i;
    }
}

TEST(PoseSolver, locatesARigByAllItsCameras) {
    RandomInputs random(7);
    const std::vector<MountedCamera> cameras{
        MountedCamera(), MountedCamera(Camera{}, {rotationExp({0, 2, 0}), {0.1, 0, -0.2}})};
    const SE3 T_body_world = random.pose();
    std::vector<PointMatch> matches;
    for (int i = 0; i < 80; ++i) {
        const MountedCamera& camera = cameras[i % 2];
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-0.8, 0.8),
                                random.uniform(1, 4));
        const Eigen::Vector3d point = (camera.T_cam_body() * T_body_world).inverse() * p;
        matches.push_back({point, measurementOf(p, camera.camera(), random, 0), 1, i % 2});
    }
    const SE3 start = T_body_world.retract(random.tangent(0.05, 0.05));
    const auto solution = solvePose(cameras, matches, start);
    EXPECT_EQ(solution.inliers, 80);
    EXPECT_LT(solution.T_body_world.minus(T_body_world).norm(), 1e-5);
}

TEST(PoseSolver, withoutMatchesKeepsThePose) {
    const auto solution = solvePose(Camera{}, {}, SE3());
    EXPECT_EQ(solution.inliers, 0);
    EXPECT_TRUE(solution.T_body_world.t.allFinite());
}

}  // namespace
}  // namespace rgbd_graphslam
