#include "rgbd_graphslam/viewer/plot_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {
namespace {

TEST(ThinnedCurve, staysAsItIsWhereItFits) {
    const std::vector<float> values = {3, 1, 2};
    EXPECT_EQ(thinnedCurve(values, 3), values);
    EXPECT_TRUE(thinnedCurve({}, 4).empty());
}

TEST(ThinnedCurve, keepsExtremesInTheirOrder) {
    std::vector<float> values(1000, 5);
    values[400] = 9;
    values[401] = 1;
    const auto thinned = thinnedCurve(values, 50);
    ASSERT_EQ(thinned.size(), 50U);
    const auto highest = std::max_element(thinned.begin(), thinned.end());
    const auto lowest = std::min_element(thinned.begin(), thinned.end());
    EXPECT_EQ(*highest, 9);
    EXPECT_EQ(*lowest, 1);
    EXPECT_EQ(lowest - highest, 1);
    EXPECT_EQ((highest - thinned.begin()) / 2, 10);  // of 25 stretches of 40 values
}

TEST(ThinnedCurve, keepsGaps) {
    std::vector<float> values(1000, 5);
    values[500] = NAN;
    std::fill(values.begin() + 700, values.begin() + 800, NAN);
    const auto thinned = thinnedCurve(values, 20);  // stretches of 100
    ASSERT_EQ(thinned.size(), 20U);
    EXPECT_EQ(std::count_if(thinned.begin(), thinned.end(), [](float v) { return std::isnan(v); }),
              3);
    EXPECT_EQ(thinned[10], 5);
    EXPECT_TRUE(std::isnan(thinned[11]));
    EXPECT_TRUE(std::isnan(thinned[14]) && std::isnan(thinned[15]));
}

TEST(AxisEnd, isTheHighestValueUnlessItStandsOut) {
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(i % 10));
    EXPECT_EQ(axisEnd(values), 9);
    values[500] = 4000;
    values[501] = NAN;
    EXPECT_FLOAT_EQ(axisEnd(values), 13.5f);
    EXPECT_EQ(axisEnd({0, 0, 7}), 7);
    EXPECT_EQ(axisEnd({NAN, NAN}), 0);
}

}  // namespace
}  // namespace rgbd_graphslam
