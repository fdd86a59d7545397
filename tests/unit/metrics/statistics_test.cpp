#include "rgbd_graphslam/metrics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(Statistics, ofKnownValues) {
    const auto s = statisticsOf({1, 2, 3, 10});
    EXPECT_EQ(s.count, 4u);
    EXPECT_DOUBLE_EQ(s.mean, 4);
    EXPECT_DOUBLE_EQ(s.median, 2.5);
    EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(114 / 4.0));
    EXPECT_DOUBLE_EQ(s.std, std::sqrt((9 + 4 + 1 + 36) / 4.0));
    EXPECT_DOUBLE_EQ(s.min, 1);
    EXPECT_DOUBLE_EQ(s.max, 10);
}

TEST(Statistics, ofNothingAreZero) {
    EXPECT_EQ(statisticsOf({}).count, 0u);
    EXPECT_EQ(statisticsOf({}).rmse, 0);
}

TEST(Percentile, isLinearBetweenNeighbors) {
    EXPECT_DOUBLE_EQ(percentileOf({30, 10, 20}, 0), 10);
    EXPECT_DOUBLE_EQ(percentileOf({30, 10, 20}, 0.25), 15);
    EXPECT_DOUBLE_EQ(percentileOf({30, 10, 20}, 1), 30);
    EXPECT_THROW(percentileOf({}, 0.5), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
