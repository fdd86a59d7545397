#include "rgbd_graphslam/navigation/planners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <cmath>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

const RobotBody square{{0, 0.5, {{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}}};

void addWall(const TPoint2D& a, const TPoint2D& b, NavigationMap& map) {
    const double step_m = map.grid.getResolution(), length_m = (b - a).norm();
    for (double s = 0; s <= length_m; s += step_m)
        map.borders.push_back(a + (b - a) * (s / length_m));
}

/** Open floor, and to the right an alley without an exit, too narrow for the robot to turn. */
NavigationMap deadEnd() {
    NavigationMap map;
    addWall({1.6, 0.34}, {4.4, 0.34}, map);
    addWall({1.6, -0.34}, {4.4, -0.34}, map);
    addWall({4.4, -0.34}, {4.4, 0.34}, map);
    return map;
}

std::vector<TPose2D> plan(const Route& route) {
    const TestFolder cache;
    DriveOptions options;
    options.rrt_limit_s = 3;
    return planMotion(deadEnd(), {0, 0, 0}, route, square, options,
                      mrpt::config::CConfigFile(RGBD_SOURCE_DIR "/ini/drive.ini"), cache / "");
}

double distance(const TPose2D& pose, const TPoint2D& p) {
    return std::hypot(pose.x - p.x, pose.y - p.y);
}

TEST(PlanMotion, goesFromLegToLeg) {
    const TPoint2D in_alley{3.2, 0}, end{3.9, 0};
    const auto poses = plan({in_alley, end});
    EXPECT_LT(distance(poses.back(), end), 0.2);
}

TEST(PlanMotion, plansTwoLegsAsOneWhereTheFirstEndsWithoutAWayOn) {
    const TPoint2D in_alley{3.2, 0}, goal{0.5, 3};
    const auto poses = plan({in_alley, goal});
    EXPECT_LT(distance(poses.back(), goal), 0.2);
    for (const TPose2D& pose : poses) EXPECT_GT(distance(pose, in_alley), 0.5);
}

TEST(PlanMotion, namesALegThatHasNoSolutionFromTheStart) {
    try {
        plan({{6, 0}, {4.4, 0}});
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("found no motion from (0.00, 0.00) to (4.40, "));
    }
}

}  // namespace
}  // namespace rgbd_graphslam
