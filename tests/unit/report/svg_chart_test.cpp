#include "rgbd_graphslam/report/svg_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(RoundStep, isOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(roundStep(10, 10), 1);
    EXPECT_DOUBLE_EQ(roundStep(0.9, 4), 0.2);
    EXPECT_DOUBLE_EQ(roundStep(2000, 4), 500);
    EXPECT_GT(roundStep(0, 4), 0);
}

TEST(ThinnedPoints, keepOrderAndExtremes) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 10000; ++i) points.emplace_back(i, 5);
    points[4321].y() = 99;
    points[4322].y() = -99;
    const auto some = thinned(points, 200);
    EXPECT_LE(some.size(), 200u);
    EXPECT_GE(some.size(), 100u);
    double low = 0, high = 0, last = -1;
    for (const auto& point : some) {
        EXPECT_GT(point.x(), last);
        last = point.x();
        low = std::min(low, point.y());
        high = std::max(high, point.y());
    }
    EXPECT_EQ(low, -99);
    EXPECT_EQ(high, 99);
    EXPECT_EQ(thinned({{0, 1}, {1, 2}}, 200).size(), 2u);
}

TEST(PlanChart, hasOneScaleForBothAxes) {
    const std::string svg = planChart({{"square", "estimate", {{0, 0}, {4, 0}, {4, 4}, {0, 4}}}});
    const auto at = svg.find("points=\"");
    double u[4], v[4];
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "points=\"%lf,%lf %lf,%lf %lf,%lf %lf,%lf", &u[0],
                          &v[0], &u[1], &v[1], &u[2], &v[2], &u[3], &v[3]),
              8);
    EXPECT_NEAR(u[1] - u[0], v[1] - v[2], 0.2);
    EXPECT_GT(u[1], u[0]);
    EXPECT_LT(v[2], v[1]);  // y points up
}

TEST(PlanChart, leavesOutWhatCannotBeDrawn) {
    EXPECT_EQ(planChart({{"none", "estimate", {}}, {"one", "truth", {{1, 1}}}}), "");
    EXPECT_THAT(planChart({{"still", "estimate", {{1, 1}, {1, 1}}}}), Not(HasSubstr("nan")));
}

TEST(TimeChart, marksSpansAndEscapesNames) {
    const std::string svg =
        timeChart({{"a<b", "value", {{0, 10}, {60, 20}}}}, "items", {{20, 30}, {40, 40}});
    EXPECT_THAT(svg, HasSubstr("a&lt;b"));
    EXPECT_THAT(svg, HasSubstr("items"));
    const auto first = svg.find("class=\"lost\"");
    ASSERT_NE(first, std::string::npos);
    EXPECT_NE(svg.find("class=\"lost\"", first + 1), std::string::npos);
    EXPECT_THAT(svg, HasSubstr("width=\"2.0\""));  // of a span without length
}

}  // namespace
}  // namespace rgbd_graphslam
