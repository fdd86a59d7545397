#include "rgbd_graphslam/metrics/drift.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/made_trajectories.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(Drift, isNoneOfTheTruthMoved) {
    const DriftResult result = evaluateDrift(moved(circle(), someMotion()), circle());
    EXPECT_LT(result.translation_percent.max, 1e-9);
    EXPECT_LT(result.rotation_deg_m.max, 1e-6);
    EXPECT_EQ(result.lengths_m.size(), 8u);
}

TEST(Drift, ofAScaleIsItsError) {
    const Trajectory truth = straight(1, 0);
    DriftOptions options;
    options.lengths_m = {2, 5};
    const DriftResult result = evaluateDrift(scaled(truth, 1.02), truth, options);
    // The first pose beyond 2 m is 2.1 m away (or 2.0 by rounding), 5 m likewise.
    EXPECT_NEAR(result.translation_percent.mean, 2, 0.15);
    EXPECT_LT(result.rotation_deg_m.max, 1e-6);
    options.fit_scale = true;
    const DriftResult fitted = evaluateDrift(scaled(truth, 1.02), truth, options);
    EXPECT_LT(fitted.translation_percent.max, 1e-9);
    EXPECT_NEAR(fitted.scale, 1 / 1.02, 1e-9);
}

TEST(Drift, ofATurnIsDegreesPerMeter) {
    DriftOptions options;
    options.lengths_m = {5};
    const DriftResult result = evaluateDrift(straight(1, 0.01), straight(1, 0), options);
    // 0.01 rad/s at 1 m/s; a pose every 0.1 m.
    EXPECT_NEAR(result.rotation_deg_m.mean, 0.01 * 180 / M_PI, 0.02 * 0.573);
}

TEST(Drift, usesTheLengthsThatTheWayHas) {
    DriftOptions options;
    options.lengths_m = {1, 4, 100};
    const DriftResult result = evaluateDrift(straight(1, 0), straight(1, 0), options);
    EXPECT_EQ(result.lengths_m, (std::vector<double>{1, 4}));
    // From each of 101 poses a pose farther than the length, as far as there is one.
    EXPECT_NEAR(static_cast<double>(result.errors.size()), 90 + 60, 2);
    const DriftResult long_way = evaluateDrift(straight(50, 0), straight(50, 0));
    EXPECT_EQ(long_way.lengths_m, (std::vector<double>{100, 200, 300, 400}));
}

TEST(Drift, saysWhyThereIsNone) {
    DriftOptions options;
    options.lengths_m = {100};
    const auto problem = [&](const Trajectory& estimate) -> std::string {
        try {
            evaluateDrift(estimate, circle(), options);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_THAT(problem(circle()), testing::HasSubstr("shorter than every length"));
    EXPECT_THAT(problem(delayed(circle(), 1000)), testing::HasSubstr("1100.0000 s"));
}

}  // namespace
}  // namespace rgbd_graphslam
