#include "rgbd_graphslam/viewer/true_errors.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

StampedPose at(double stamp_s, double x) {
    return {stamp_s, SE3(Eigen::Matrix3d::Identity(), {x, 0, 0})};
}

TEST(TrueErrors, arePairsOfTheSameMoment) {
    const Trajectory estimate = {at(1, 0), at(2, 1), at(3, 2), at(5, 4)};
    const Trajectory truth = {at(0, 9), at(2, 1.5), at(4, 9), at(5.0000004, 4), at(6, 9)};
    const auto errors = trueErrors(estimate, truth);
    ASSERT_EQ(errors.size(), 2U);
    EXPECT_EQ(errors[0].stamp_s, 2);
    EXPECT_DOUBLE_EQ(errors[0].m(), 0.5);
    EXPECT_EQ(errors[1].truth.x(), 4);
    EXPECT_TRUE(trueErrors(estimate, {}).empty());
    EXPECT_TRUE(trueErrors({}, truth).empty());
}

TEST(TrueErrors, areDrawnAsLongAsIsSeenInTheScene) {
    const auto of = [](double error_m) {
        return trueErrors({at(1, 0), at(2, 1)}, {at(1, error_m), at(2, 1 - error_m)});
    };
    EXPECT_EQ(visibleScale(of(0.007), 24), 20);
    EXPECT_EQ(visibleScale(of(0.007), 5), 5);
    EXPECT_EQ(visibleScale(of(0.5), 24), 1);
    EXPECT_EQ(visibleScale(of(1e-5), 24), 100);
    EXPECT_EQ(visibleScale({}, 24), 1);
}

}  // namespace
}  // namespace rgbd_graphslam
