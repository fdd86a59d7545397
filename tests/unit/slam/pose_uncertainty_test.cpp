#include "../../../libs/slam/src/pose_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../estimation/measurements.h"

namespace rgbd_graphslam {
namespace {

const Camera camera;

/** Matches of a camera that is where it is said to be. \param focal of the images that it takes, as
 *  a factor of what its calibration says */
std::vector<PointMatch> matchesWith(RandomInputs& random, double focal) {
    std::vector<PointMatch> matches;
    while (matches.size() < 200) {
        const Eigen::Vector3d p(random.uniform(-2, 2), random.uniform(-1.5, 1.5),
                                random.uniform(1, 4));
        if (!camera.contains(camera.project(p))) continue;
        Measurement m = measurementOf(p, camera, random, 1);
        m.u = 319.5 + focal * (m.u - 319.5);
        m.v = 239.5 + focal * (m.v - 239.5);
        matches.push_back({p, m});
    }
    return matches;
}

double meanDisagreement(double focal) {
    constexpr int trials = 60;
    RandomInputs random(8);
    const RigCameras cameras(camera);
    double sum = 0;
    for (int i = 0; i < trials; ++i) {
        const auto matches = matchesWith(random, focal);
        LocatedFrame located;
        located.T_cam_world = solvePose(cameras.mounted(), matches, SE3()).T_body_world;
        sum += disagreementOfHalves(matches, cameras, located).value_or(0) / trials;
    }
    return sum;
}

TEST(DisagreementOfHalves, isOneForIndependentErrors) {
    EXPECT_NEAR(meanDisagreement(1), 1, 0.25);
}

TEST(DisagreementOfHalves, findsAWrongFocalLength) {
    EXPECT_GT(meanDisagreement(1.01), 2);
}

TEST(DisagreementOfHalves, saysNothingOfFewLandmarks) {
    RandomInputs random(8);
    auto matches = matchesWith(random, 1);
    matches.resize(30);
    EXPECT_FALSE(disagreementOfHalves(matches, RigCameras(camera), {}));
}

SE3 ahead(double m) {
    return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, -m)};
}

KeyframeTie tieTo(int keyframe, double m, const PoseSpread& spread) {
    return {keyframe, ahead(m), covarianceOf(spread)};
}

PoseSpread sigmaOf(const MapUncertainty& uncertainty, int keyframe) {
    return weakestDirection(uncertainty.inWorld(Matrix6d::Zero(), keyframe, SE3(), SE3()));
}

TEST(MapUncertainty, growsAlongTheWayAndShrinksByLoops) {
    MapUncertainty uncertainty;
    uncertainty.add({});
    for (int i = 1; i < 50; ++i) uncertainty.add({tieTo(i - 1, 0.2, {0.002, 0.001})});
    EXPECT_LT(sigmaOf(uncertainty, 0).m, sigmaOf(uncertainty, 10).m);
    EXPECT_LT(sigmaOf(uncertainty, 10).m, sigmaOf(uncertainty, 49).m);
    uncertainty.add({tieTo(49, 1, {0.05, 0.01})});
    EXPECT_GT(sigmaOf(uncertainty, 50).m, 0.05);
    uncertainty.closeLoop(10, 50, SE3());
    EXPECT_EQ(sigmaOf(uncertainty, 50).m, sigmaOf(uncertainty, 10).m);
}

/** Monte Carlo: a chain of noisy motions, and what its last pose errs to the side. */
TEST(MapUncertainty, anUncertainRotationMovesWhatLiesAhead) {
    constexpr int keyframes = 20, trials = 400;
    constexpr PoseSpread noise{0.001, 0.004};
    MapUncertainty uncertainty;
    uncertainty.add({});
    for (int i = 1; i < keyframes; ++i) uncertainty.add({tieTo(i - 1, 0.3, noise)});
    RandomInputs random(4);
    double variance = 0;
    for (int trial = 0; trial < trials; ++trial) {
        SE3 T, true_T;
        for (int i = 1; i < keyframes; ++i) {
            Vector6d error;
            for (int k = 0; k < 6; ++k)
                error[k] = (k < 3 ? noise.m : noise.rad) * std::sqrt(3.) * random.uniform(-1, 1);
            T = (ahead(0.3) * T).retract(error);
            true_T = ahead(0.3) * true_T;
        }
        variance += std::pow(T.minus(true_T)[0], 2) / trials;
    }
    const double claimed =
        std::sqrt(uncertainty.inWorld(Matrix6d::Zero(), keyframes - 1, SE3(), SE3())(0, 0));
    EXPECT_NEAR(claimed / std::sqrt(variance), 1, 0.15);
}

TEST(MapUncertainty, takesTheTieThatLeavesLeast) {
    MapUncertainty uncertainty;
    uncertainty.add({});
    uncertainty.add({tieTo(0, 0.2, {0.02, 0.01})});
    uncertainty.add({tieTo(1, 0.2, {0.001, 0.001}), tieTo(0, 0.4, {0.004, 0.002})});
    EXPECT_LT(sigmaOf(uncertainty, 2).m, 0.01);
}

TEST(MapUncertainty, systematicErrorsGrowWithTheWayAndWithDisagreement) {
    MapUncertainty uncertainty;
    uncertainty.add({});
    const auto sigma = [&](double m) {
        return weakestDirection(uncertainty.inWorld(Matrix6d::Zero(), 0, SE3(), ahead(m))).m;
    };
    EXPECT_GT(sigma(5), 3 * sigma(0));
    const double before = sigma(5);
    for (int i = 0; i < 9; ++i) uncertainty.note(3.0);
    EXPECT_EQ(uncertainty.scale(), 3);
    EXPECT_GT(sigma(5), 2 * before);
    uncertainty.note(std::nullopt);
    EXPECT_EQ(uncertainty.scale(), 3);
}

}  // namespace
}  // namespace rgbd_graphslam
