#include "rgbd_graphslam/viewer/measuring.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(Measuring, saysDistanceAndItsParts) {
    Measuring measuring;
    measuring.toggle();
    measuring.add(Eigen::Vector3d(1, 1, 0));
    EXPECT_EQ(measuring.add(Eigen::Vector3d(4, 5, 12)),
              "distance 13.000 m: 5.000 m on the level, 12.000 m in height");
    EXPECT_EQ(measuring.points().size(), 2U);
}

TEST(Measuring, theThirdPointStartsAnew) {
    Measuring measuring;
    measuring.toggle();
    for (const double x : {0., 1., 2.}) measuring.add(Eigen::Vector3d(x, 0, 0));
    ASSERT_EQ(measuring.points().size(), 1U);
    EXPECT_EQ(measuring.points()[0].x(), 2);
}

TEST(Measuring, whereNothingIsThereIsNoPoint) {
    Measuring measuring;
    measuring.toggle();
    measuring.add(Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(measuring.add(std::nullopt), "nothing there to measure");
    EXPECT_EQ(measuring.points().size(), 1U);
}

TEST(Measuring, stoppingForgetsThePoints) {
    Measuring measuring;
    EXPECT_FALSE(measuring.active());
    measuring.toggle();
    EXPECT_TRUE(measuring.active());
    measuring.add(Eigen::Vector3d(0, 0, 0));
    measuring.toggle();
    EXPECT_FALSE(measuring.active());
    EXPECT_TRUE(measuring.points().empty());
}

}  // namespace
}  // namespace rgbd_graphslam
