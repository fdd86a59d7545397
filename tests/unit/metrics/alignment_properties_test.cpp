/** What holds for any alignment. */
#include <gtest/gtest.h>

#include "../../support/made_trajectories.h"
#include "../../support/random_inputs.h"
#include "rgbd_graphslam/metrics/ate.h"

namespace rgbd_graphslam {
namespace {

constexpr int trials = 100;

Eigen::Matrix3Xd cloud(int points, RandomInputs& random) {
    Eigen::Matrix3Xd positions(3, points);
    for (int i = 0; i < points; ++i) positions.col(i) = random.vector(3);
    return positions;
}

double squaredError(const Similarity& found, const Eigen::Matrix3Xd& from,
                    const Eigen::Matrix3Xd& to) {
    double sum = 0;
    for (int i = 0; i < from.cols(); ++i) {
        sum += (found * Eigen::Vector3d(from.col(i)) - to.col(i)).squaredNorm();
    }
    return sum;
}

TEST(AlignmentProperties, noMotionNearbyFitsBetter) {
    RandomInputs random(1);
    for (int i = 0; i < trials; ++i) {
        const auto from = cloud(10, random), to = cloud(10, random);
        const Similarity best = alignPoints(from, to);
        for (const double step : {1e-4, 1e-2, 1.0}) {
            Similarity other = best;
            other.motion = best.motion.retract(random.tangent(step, step));
            EXPECT_GE(squaredError(other, from, to), squaredError(best, from, to));
        }
    }
}

TEST(AlignmentProperties, noScaleNearbyFitsBetter) {
    RandomInputs random(2);
    for (int i = 0; i < trials; ++i) {
        const auto from = cloud(10, random), to = cloud(10, random);
        const Similarity best = alignPoints(from, to, AlignmentScale::Fitted);
        for (const double factor : {0.9, 0.999, 1.001, 1.1}) {
            Similarity other = best;
            other.scale *= factor;
            EXPECT_GE(squaredError(other, from, to), squaredError(best, from, to));
        }
    }
}

/** The path with errors of some centimeters. */
Trajectory estimateOf(Trajectory path, RandomInputs& random) {
    for (auto& pose : path) pose.T_world_cam.t += random.vector(0.05);
    return path;
}

TEST(AlignmentProperties, ateDoesNotDependOnTheFrameOfEither) {
    RandomInputs random(3);
    for (int i = 0; i < trials; ++i) {
        const Trajectory truth = circle(), estimate = estimateOf(truth, random);
        const double rmse = evaluateAte(estimate, truth).translation_m.rmse;
        ASSERT_GT(rmse, 0.01);
        EXPECT_NEAR(evaluateAte(moved(estimate, random.pose()), truth).translation_m.rmse, rmse,
                    1e-12);
        EXPECT_NEAR(evaluateAte(estimate, moved(truth, random.pose())).translation_m.rmse, rmse,
                    1e-12);
    }
}

TEST(AlignmentProperties, ateGrowsWithTheScaleOfBoth) {
    RandomInputs random(4);
    for (int i = 0; i < trials; ++i) {
        const Trajectory truth = circle(), estimate = estimateOf(truth, random);
        const double scale = random.uniform(0.1, 10);
        const double rmse = evaluateAte(estimate, truth).translation_m.rmse;
        EXPECT_NEAR(evaluateAte(scaled(estimate, scale), scaled(truth, scale)).translation_m.rmse,
                    scale * rmse, 1e-11);
    }
}

TEST(AlignmentProperties, aFittedScaleUndoesAnyScaleOfTheEstimate) {
    RandomInputs random(5);
    AteOptions options;
    options.fit_scale = true;
    for (int i = 0; i < trials; ++i) {
        const Trajectory truth = circle(), estimate = estimateOf(truth, random);
        const double rmse = evaluateAte(estimate, truth, options).translation_m.rmse;
        const Trajectory other = scaled(estimate, random.uniform(0.1, 10));
        EXPECT_NEAR(evaluateAte(other, truth, options).translation_m.rmse, rmse, 1e-12);
    }
}

TEST(AlignmentProperties, swappingTheTwoInvertsTheMotion) {
    RandomInputs random(6);
    for (int i = 0; i < trials; ++i) {
        const auto from = cloud(10, random);
        const SE3 motion = random.pose();
        Eigen::Matrix3Xd to = from;
        for (int k = 0; k < to.cols(); ++k) {
            to.col(k) = motion * Eigen::Vector3d(from.col(k)) + random.vector(0.3);
        }
        const SE3 there = alignPoints(from, to).motion, back = alignPoints(to, from).motion;
        EXPECT_LT((there * back).minus(SE3()).norm(), 1e-10);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
