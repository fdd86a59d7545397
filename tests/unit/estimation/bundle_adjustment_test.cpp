#include "rgbd_graphslam/estimation/bundle_adjustment.h"

#include <gtest/gtest.h>

#include "../../support/problem_of.h"
#include "bundle.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/estimation/point_observation.h"
#include "rgbd_graphslam/estimation/pose_prior.h"
#include "rgbd_graphslam/estimation/relative_pose.h"

namespace rgbd_graphslam {
namespace {

/** Two cameras that look the same way and another way. */
std::vector<MountedCamera> rig() {
    Intrinsics wide;
    wide.fx = wide.fy = 380;
    return {MountedCamera(), MountedCamera(wide, {rotationExp({0, 1.5, 0}), {0.1, 0.02, -0.05}})};
}

Matrix6d informationOf(double sigma_m, double sigma_rad) {
    Vector6d sigma;
    sigma << Eigen::Vector3d::Constant(sigma_m), Eigen::Vector3d::Constant(sigma_rad);
    return sigma.cwiseAbs2().cwiseInverse().asDiagonal();
}

/** Relative poses along the way, with the motion of one of them wrong but survivable. */
void addRelativePoses(Bundle& bundle) {
    for (int k = 1; k < 8; ++k) {
        SE3 measured = bundle.truth[k - 1] * bundle.truth[k].inverse();
        if (k == 3) measured.t.x() += 0.5;
        bundle.problem.factors.push_back(std::make_shared<RelativePose>(
            k - 1, k, measured, informationOf(0.01, 0.01), RobustKernel{KernelShape::Cauchy, 9}));
    }
}

TEST(BundleAdjustment, reachesZeroWithoutNoise) {
    Bundle bundle = someBundle(1, 0, 0);
    const auto summary = adjustBundle(bundle.problem, 30, false);
    EXPECT_GT(summary.initial_cost, 1000);
    EXPECT_LT(summary.final_cost, 1e-6);
    EXPECT_LT(largestError(bundle), 1e-5);
}

TEST(BundleAdjustment, reachesTheMinimumOfCeres) {
    BundleProblem ours = someBundle(2, 1, 0.05).problem, theirs = ours;
    const auto summary = adjustBundle(ours, 100, false);
    const auto reference = adjustBundleSparse(theirs, 100, false);
    EXPECT_NEAR(summary.initial_cost, reference.initial_cost, 1e-9 * summary.initial_cost);
    EXPECT_NEAR(summary.final_cost, reference.final_cost, 1e-6 * reference.final_cost);
    EXPECT_NEAR(bundleCost(ours), summary.final_cost, 1e-9 * summary.final_cost);
    EXPECT_LT(largestDifference(ours.states, theirs.states), 1e-4);
}

TEST(BundleAdjustment, aRigIsAdjustedAsOneBody) {
    Bundle bundle = someBundle(3, 0, 0, rig());
    adjustBundle(bundle.problem, 30, false);
    EXPECT_LT(largestError(bundle), 1e-5);
    Bundle noisy = someBundle(3, 1, 0.02, rig()), theirs = noisy;
    adjustBundle(noisy.problem, 100, false);
    adjustBundleSparse(theirs.problem, 100, false);
    EXPECT_LT(largestDifference(noisy.problem.states, theirs.problem.states), 1e-4);
}

TEST(BundleAdjustment, marksWrongObservationsAndLeavesFixedKeyframesAlone) {
    BundleProblem problem = someBundle(4, 0.3, 0.05).problem;
    const BundleProblem start = problem;
    adjustBundle(problem, 20);
    int marked = 0;
    for (const auto& o : problem.observations) marked += o.outlier;
    EXPECT_GT(marked, 50);
    EXPECT_LT(marked, 130) << "1600 observations, about 80 of them wrong";
    for (int k = 6; k < 8; ++k) {
        const SE3 &pose = problem.states.keyframes[k].T_body_world,
                  &before = start.states.keyframes[k].T_body_world;
        EXPECT_EQ(pose.R, before.R);
        EXPECT_EQ(pose.t, before.t);
    }
}

TEST(BundleAdjustment, weighsRelativePosesAgainstPointsAsCeresDoes) {
    Bundle bundle = someBundle(5, 1, 0.02);
    addRelativePoses(bundle);
    BundleProblem ours = bundle.problem, theirs = ours;
    const auto summary = adjustBundle(ours, 100, false);
    const auto reference = adjustBundleSparse(theirs, 100, false);
    EXPECT_NEAR(summary.initial_cost, reference.initial_cost, 1e-9 * summary.initial_cost);
    EXPECT_NEAR(summary.final_cost, reference.final_cost, 1e-6 * reference.final_cost);
    EXPECT_LT(largestDifference(ours.states, theirs.states), 1e-4);
}

TEST(BundleAdjustment, needsNoPointsWherePriorAndRelativePosesTell) {
    for (const auto& adjust : {adjustBundle, adjustBundleSparse}) {
        Bundle bundle = someBundle(6, 0, 0);
        BundleProblem& problem = bundle.problem;
        problem.observations.clear();
        problem.states.points.clear();
        problem.free_keyframes = 8;
        addRelativePoses(bundle);
        const Matrix6d tight = informationOf(1e-3, 1e-3);
        problem.factors.push_back(std::make_shared<PosePrior>(0, bundle.truth[0], tight));
        problem.factors.push_back(std::make_shared<PosePrior>(7, bundle.truth[7], tight));
        adjust(problem, 100, false);
        EXPECT_LT(largestError(bundle), 0.02) << "the wrong edge has little say";
        EXPECT_GT(largestError(bundle), 1e-6);
    }
}

TEST(BundleAdjustment, refusesFactorsOverPoints) {
    Bundle bundle = someBundle(7, 0, 0);
    const MountedCamera camera;
    bundle.problem.factors.push_back(
        std::make_shared<PointObservation>(camera, 0, 0, measurementAt({1, 2}, 3)));
    EXPECT_EQ(problemOf([&] { adjustBundle(bundle.problem, 1); }),
              "a factor of the windowed bundle adjustment names a point; "
              "give points observations, or use adjustBundleSparse");
    EXPECT_EQ(problemOf([&] { adjustBundleSparse(bundle.problem, 1); }), "");
}

}  // namespace
}  // namespace rgbd_graphslam
