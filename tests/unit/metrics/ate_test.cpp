#include "rgbd_graphslam/metrics/ate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "../../support/made_trajectories.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(Ate, doesNotSeeWhereTheEstimateStarts) {
    const auto result = evaluateAte(moved(circle(), someMotion()), circle());
    EXPECT_LT(result.translation_m.max, 1e-12);
    EXPECT_EQ(result.pairs.size(), 101u);
    EXPECT_EQ(result.estimate_poses, 101u);
}

TEST(Ate, alignmentBringsTheEstimateOverTheTruth) {
    const auto truth = circle(), estimate = moved(truth, someMotion());
    const auto aligned = evaluateAte(estimate, truth).alignment * estimate[3].T_world_cam;
    EXPECT_TRUE(aligned.t.isApprox(truth[3].T_world_cam.t, 1e-12));
    EXPECT_TRUE(aligned.R.isApprox(truth[3].T_world_cam.R, 1e-12));
}

TEST(Ate, ofErrorsThatNoAlignmentRemoves) {
    auto estimate = circle(1001);
    for (std::size_t k = 0; k < estimate.size(); ++k) {
        estimate[k].T_world_cam.t.z() += k % 2 ? 0.01 : -0.01;
    }
    const auto errors = evaluateAte(estimate, circle(1001)).translation_m;
    EXPECT_NEAR(errors.rmse, 0.01, 1e-5);
    EXPECT_NEAR(errors.mean, 0.01, 1e-5);
    EXPECT_NEAR(errors.std, 0, 1e-4);
}

TEST(Ate, ofEvenNoiseIsItsSpread) {
    const double half_width_m = 0.02;
    std::mt19937 random(5);
    const auto noise = [&] { return half_width_m * (2.0 * random() / random.max() - 1); };
    auto estimate = circle(2001);
    for (auto& pose : estimate) pose.T_world_cam.t += Eigen::Vector3d(noise(), noise(), noise());
    // An even distribution of half width h has the variance h^2 / 3 on each of the three axes.
    EXPECT_NEAR(evaluateAte(estimate, circle(2001)).translation_m.rmse, half_width_m, 0.0004);
}

TEST(Ate, saysWhichScaleWouldFit) {
    const auto estimate = moved(scaled(circle(), 1 / 1.04), someMotion());
    const auto as_is = evaluateAte(estimate, circle());
    ASSERT_TRUE(as_is.fitted_scale);
    EXPECT_NEAR(*as_is.fitted_scale, 1.04, 1e-12);
    EXPECT_GT(as_is.translation_m.rmse, 0.03);

    AteOptions given;
    given.scale = 1.04;
    EXPECT_LT(evaluateAte(estimate, circle(), given).translation_m.max, 1e-12);
    AteOptions fitted;
    fitted.fit_scale = true;
    const auto result = evaluateAte(estimate, circle(), fitted);
    EXPECT_LT(result.translation_m.max, 1e-12);
    EXPECT_NEAR(result.alignment.scale, 1.04, 1e-12);
}

TEST(Ate, noScaleFitsACameraThatStandsStill) {
    auto still = circle();
    for (auto& pose : still) pose.T_world_cam.t = {1, 2, 3};
    EXPECT_FALSE(evaluateAte(still, still).fitted_scale);
    EXPECT_NEAR(evaluateAte(still, still).translation_m.max, 0, 1e-12);
}

TEST(Ate, offsetIsAddedToTheEstimate) {
    const auto late = delayed(circle(), 2.5);
    AteOptions options;
    options.offset_s = -2.5;
    const auto result = evaluateAte(late, circle(), options);
    EXPECT_EQ(result.pairs.size(), 101u);
    EXPECT_LT(result.translation_m.max, 1e-12);
    EXPECT_NEAR(result.pairs.front().stamp_s, 100, 1e-9);
}

TEST(Ate, countsPosesWithoutTruth) {
    auto truth = circle();
    truth.resize(60);
    const auto result = evaluateAte(circle(), truth);
    EXPECT_EQ(result.pairs.size(), 60u);
    EXPECT_EQ(result.estimate_poses, 101u);
}

TEST(Ate, ofPosesWithOneStampTheLastCounts) {
    auto estimate = circle();
    auto wrong = estimate[50];
    wrong.T_world_cam.t.x() += 1;
    estimate.insert(estimate.begin() + 50, wrong);
    const auto result = evaluateAte(estimate, circle());
    EXPECT_EQ(result.estimate_poses, 101u);
    EXPECT_LT(result.translation_m.max, 1e-12);
}

TEST(Ate, namesTheSpansWhenNothingMatches) {
    try {
        evaluateAte(delayed(circle(), 1000), circle());
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("1100.0000 s to 1110.0000 s"),
                                             testing::HasSubstr("100.0000 s to 110.0000 s"),
                                             testing::HasSubstr("--offset")));
    }
    EXPECT_THROW(evaluateAte({}, circle()), Error);
    EXPECT_THROW(evaluateAte(circle(), {}), Error);
}

TEST(Ate, refusesAScaleThatIsNone) {
    AteOptions options;
    options.scale = std::nan("");
    EXPECT_THROW(evaluateAte(circle(), circle(), options), Error);
    options.scale = 0;
    EXPECT_THROW(evaluateAte(circle(), circle(), options), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
