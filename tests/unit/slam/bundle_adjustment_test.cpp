#include "rgbd_graphslam/slam/bundle_adjustment.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/global_adjustment.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

/** Eight cameras, two of them fixed, that see 200 points with noise; poses and points start off. */
BundleProblem makeProblem(double noise, double wrong) {
    SyntheticWorld random(1, 11);
    BundleProblem problem;
    const SensorOptions sensor;
    std::vector<SE3> truth;
    for (int c = 0; c < 8; ++c) {
        truth.emplace_back(rotationExp({0.02 * c, 0.05 * c, 0}),
                           Eigen::Vector3d(0.1 * c, 0, 0.05 * c));
    }
    problem.free_cameras = 6;
    for (int p = 0; p < 200; ++p) {
        const Eigen::Vector3d point(random.uniform(-1, 1), random.uniform(-0.7, 0.7),
                                    random.uniform(1.5, 4));
        problem.points.push_back(
            point + 0.02 * Eigen::Vector3d(random.gauss(), random.gauss(), random.gauss()));
        for (int c = 0; c < 8; ++c) {
            const Eigen::Vector3d q = truth[c] * point;
            const Eigen::Vector2d pixel = problem.camera.project(q);
            Keypoint k{static_cast<float>(pixel.x() + noise * random.gauss()),
                       static_cast<float>(pixel.y() + noise * random.gauss()),
                       p % 5 ? static_cast<float>(q.z()) : 0, 0, 0};
            if (random.uniform(0, 1) < wrong) k.u += 40;
            problem.observations.push_back({c, p, measurementOf(k, 1, sensor)});
        }
    }
    for (int c = 0; c < 8; ++c) {
        Vector6d off;
        for (int i = 0; i < 6; ++i) off(i) = c < 6 ? 0.01 * random.gauss() : 0;
        problem.T_cam_world.push_back(truth[c].retract(off));
    }
    return problem;
}

TEST(BundleAdjustment, reachesZeroWithoutNoise) {
    BundleProblem problem = makeProblem(0, 0);
    const auto summary = adjustBundle(problem, 30, false);
    EXPECT_GT(summary.initial_cost, 1000);
    EXPECT_LT(summary.final_cost, 1e-2) << "what is left is the rounding of float keypoints";
}

TEST(BundleAdjustment, reachesTheMinimumOfCeres) {
    BundleProblem ours = makeProblem(0.8, 0.05), theirs = ours;
    const auto summary = adjustBundle(ours, 100, false);
    const auto reference = adjustBundleSparse(theirs, 100, false);
    EXPECT_NEAR(summary.final_cost, reference.final_cost, 1e-6 * reference.final_cost);
    EXPECT_NEAR(bundleCost(ours), summary.final_cost, 1e-9 * summary.final_cost);
    for (std::size_t c = 0; c < ours.T_cam_world.size(); ++c) {
        EXPECT_LT(ours.T_cam_world[c].minus(theirs.T_cam_world[c]).norm(), 1e-4);
    }
}

TEST(BundleAdjustment, marksWrongObservationsAndLeavesFixedCamerasAlone) {
    BundleProblem problem = makeProblem(0.3, 0.05);
    const BundleProblem start = problem;
    adjustBundle(problem, 20);
    int marked = 0;
    for (const auto& o : problem.observations) marked += o.outlier;
    EXPECT_GT(marked, 50);
    EXPECT_LT(marked, 130) << "1600 observations, about 80 of them wrong";
    for (int c = 6; c < 8; ++c) {
        EXPECT_EQ(problem.T_cam_world[c].R, start.T_cam_world[c].R);
        EXPECT_EQ(problem.T_cam_world[c].t, start.T_cam_world[c].t);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
