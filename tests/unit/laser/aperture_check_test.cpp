/** Apertures that are recorded wrongly. */
#include "rgbd_graphslam/laser/aperture_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/floor_plan.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;

/** A robot that turns on its way through a room. \param aperture_factor error of the recording */
std::vector<PlacedScan> turningRobot(double aperture_factor, double yaw_factor) {
    FloorPlan plan;
    plan.addBox(0, 0, 9, 6);
    plan.addBox(3, 2, 4, 2.5);
    RandomInputs random(1);
    const auto truth = driveAlong({{1, 1}, {7, 1}, {7, 5}, {2, 5}, {1, 1}, {5, 4}, {8, 1}});
    const auto odometry = odometryOf(truth, 1, yaw_factor, random);
    std::vector<PlacedScan> scans;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        auto scan = scanOf(plan, truth[i], 0.1 * static_cast<double>(i), random);
        scan->sensorPose = {};
        scan->aperture *= static_cast<float>(aperture_factor);
        scans.push_back({scan, odometry[i]});
    }
    return scans;
}

TEST(ApertureCheck, saysNothingWhereAllIsWell) {
    const ApertureVerdict verdict = checkAperture(turningRobot(1, 1.05));
    EXPECT_EQ(verdict.warning, "");
    EXPECT_EQ(verdict.factor, 1);
    EXPECT_NEAR(verdict.turn_ratio, 1 / 1.05, 0.05);
}

TEST(ApertureCheck, correctsHalfOfTheTrueAperture) {
    const ApertureVerdict verdict = checkAperture(turningRobot(0.5, 1));
    EXPECT_EQ(verdict.factor, 2);
    EXPECT_THAT(verdict.warning, HasSubstr("recorded as 135 degrees"));
    EXPECT_THAT(verdict.warning, HasSubstr("using 270"));
}

TEST(ApertureCheck, blamesTheOdometryWhereWallsAreStraight) {
    const ApertureVerdict verdict = checkAperture(turningRobot(1, 2));
    EXPECT_EQ(verdict.factor, 1);
    EXPECT_THAT(verdict.warning, HasSubstr("turn 0.50 times as far as the odometry"));
}

TEST(ApertureCheck, aRobotThatNeverTurnsTellsNothing) {
    auto scans = turningRobot(0.5, 1);
    scans.resize(50);
    EXPECT_EQ(checkAperture(scans).warning, "");
}

}  // namespace
}  // namespace rgbd_graphslam
