#include "rgbd_graphslam/metrics/rpe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../../support/made_trajectories.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

RpeOptions apart(double delta, DeltaUnit unit) {
    RpeOptions options;
    options.fixed_delta = true;
    options.delta = delta;
    options.unit = unit;
    options.max_pairs = 0;
    return options;
}

TEST(Rpe, doesNotSeeWhereTheEstimateStarts) {
    const auto result =
        evaluateRpe(moved(circle(), someMotion()), circle(), apart(1, DeltaUnit::Seconds));
    EXPECT_LT(result.translation_m.max, 1e-12);
    EXPECT_LT(result.rotation_deg.max, 1e-6);
}

TEST(Rpe, ofKnownDriftASecond) {
    const auto truth = straight(1, 0), estimate = straight(1.02, 0);
    const auto result = evaluateRpe(estimate, truth, apart(1, DeltaUnit::Seconds));
    EXPECT_NEAR(result.translation_m.min, 0.02, 1e-9);
    EXPECT_NEAR(result.translation_m.max, 0.02, 1e-9);
    EXPECT_LT(result.rotation_deg.max, 1e-6);
    // Pairs that would end at or beyond the last pose are left out: 101 - 11.
    EXPECT_EQ(result.errors.size(), 90u);
}

TEST(Rpe, ofKnownTurnASecond) {
    const double drift_rad_s = M_PI / 180;
    const auto result =
        evaluateRpe(straight(0, 0.2 + drift_rad_s), straight(0, 0.2), apart(2, DeltaUnit::Seconds));
    EXPECT_NEAR(result.rotation_deg.min, 2, 1e-9);
    EXPECT_NEAR(result.rotation_deg.max, 2, 1e-9);
    EXPECT_LT(result.translation_m.max, 1e-12);
}

TEST(Rpe, deltaInEachUnitPairsTheSamePoses) {
    // A tenth of a second of this estimate is 0.05 m and 0.03 rad: five frames are 0.5 s, ....
    const auto estimate = straight(0.5, 0.3), truth = straight(0.48, 0.3);
    const auto by_frames = evaluateRpe(estimate, truth, apart(5, DeltaUnit::Frames));
    for (const auto& options :
         {apart(0.5, DeltaUnit::Seconds), apart(0.25, DeltaUnit::Meters),
          apart(0.15, DeltaUnit::Radians), apart(0.15 * 180 / M_PI, DeltaUnit::Degrees)}) {
        const auto result = evaluateRpe(estimate, truth, options);
        ASSERT_EQ(result.errors.size(), by_frames.errors.size());
        for (std::size_t k = 0; k < result.errors.size(); ++k) {
            EXPECT_EQ(result.errors[k].to_s, by_frames.errors[k].to_s);
        }
    }
    EXPECT_NEAR(by_frames.errors.front().to_s, 0.5, 1e-12);
}

TEST(Rpe, scaleIsAFactorOnTheEstimate) {
    auto options = apart(1, DeltaUnit::Seconds);
    options.scale = 2;
    EXPECT_LT(evaluateRpe(straight(0.5, 0), straight(1, 0), options).translation_m.max, 1e-12);
}

TEST(Rpe, offsetIsAddedToTheEstimate) {
    auto options = apart(1, DeltaUnit::Seconds);
    options.offset_s = 3;
    const auto result = evaluateRpe(delayed(circle(), -3), circle(), options);
    EXPECT_LT(result.translation_m.max, 1e-12);
    EXPECT_EQ(result.matched_poses, 101u);
}

TEST(Rpe, takesAllPairsWhenThereIsNoFixedDelta) {
    RpeOptions options;
    options.max_pairs = 0;
    const auto result = evaluateRpe(circle(21), circle(21), options);
    EXPECT_EQ(result.errors.size(), 21u * 21u);
}

std::vector<double> startsOf(const RpeResult& result) {
    std::vector<double> starts_s;
    for (const auto& error : result.errors) starts_s.push_back(error.from_s);
    return starts_s;
}

TEST(Rpe, drawingDependsOnTheSeedAlone) {
    RpeOptions options;
    options.max_pairs = 500;
    const auto first = evaluateRpe(circle(), circle(), options);
    EXPECT_EQ(first.errors.size(), 500u);
    EXPECT_EQ(startsOf(evaluateRpe(circle(), circle(), options)), startsOf(first));
    options.seed = 1;
    EXPECT_NE(startsOf(evaluateRpe(circle(), circle(), options)), startsOf(first));
}

TEST(Rpe, drawnPairsOfAFixedDeltaAreDistinct) {
    auto options = apart(1, DeltaUnit::Seconds);
    options.max_pairs = 40;
    auto starts_s = startsOf(evaluateRpe(circle(), circle(), options));
    EXPECT_EQ(starts_s.size(), 40u);
    std::sort(starts_s.begin(), starts_s.end());
    EXPECT_EQ(std::adjacent_find(starts_s.begin(), starts_s.end()), starts_s.end());
}

TEST(Rpe, leavesOutPosesInGapsOfTheTruth) {
    auto truth = straight(1, 0);
    truth.erase(truth.begin() + 30, truth.begin() + 60);  // 3.0 s to 5.9 s
    auto options = apart(1, DeltaUnit::Frames);
    options.offset_s = 0.01;
    const auto result = evaluateRpe(straight(1, 0), truth, options);
    // Within twice the interval of 0.1 s are one pose after the last truth, two before the next.
    EXPECT_EQ(result.matched_poses, 101u - 30u + 3u);
    EXPECT_EQ(result.estimate_poses, 101u);
    for (const auto& error : result.errors) {
        EXPECT_TRUE(error.to_s < 3.05 || error.from_s > 5.75) << error.from_s;
    }
}

TEST(Rpe, namesTheSpansWhenNothingMatches) {
    try {
        evaluateRpe(delayed(circle(), 1000), circle(), apart(1, DeltaUnit::Seconds));
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("1100.0000 s to 1110.0000 s"),
                                             testing::HasSubstr("100.0000 s to 110.0000 s")));
    }
    EXPECT_THROW(evaluateRpe(circle(1), circle()), Error);
    EXPECT_THROW(evaluateRpe(circle(), {}), Error);
}

TEST(Rpe, refusesADeltaLongerThanThePath) {
    EXPECT_THROW(evaluateRpe(circle(), circle(), apart(60, DeltaUnit::Seconds)), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
