#include "rgbd_graphslam/metrics/alignment.h"

#include <gtest/gtest.h>

#include "../../support/made_trajectories.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

Eigen::Matrix3Xd positionsOf(const Trajectory& path) {
    Eigen::Matrix3Xd positions(3, path.size());
    for (std::size_t k = 0; k < path.size(); ++k) positions.col(k) = path[k].T_world_cam.t;
    return positions;
}

TEST(Alignment, findsTheMotionBetweenTwoCopies) {
    const auto path = circle();
    const auto found = alignPoints(positionsOf(path), positionsOf(moved(path, someMotion())));
    EXPECT_EQ(found.scale, 1);
    EXPECT_TRUE(found.motion.R.isApprox(someMotion().R, 1e-12));
    EXPECT_TRUE(found.motion.t.isApprox(someMotion().t, 1e-12));
}

TEST(Alignment, findsTheScaleWhenAsked) {
    const auto path = circle();
    const auto target = moved(scaled(path, 1.07), someMotion());
    const auto found = alignPoints(positionsOf(path), positionsOf(target), AlignmentScale::Fitted);
    EXPECT_NEAR(found.scale, 1.07, 1e-12);
    EXPECT_TRUE(found.motion.R.isApprox(someMotion().R, 1e-12));
    const Eigen::Vector3d p = path[7].T_world_cam.t;
    EXPECT_TRUE((found * p).isApprox(target[7].T_world_cam.t, 1e-12));
}

TEST(Alignment, isARotationEvenForMirroredPoints) {
    const auto path = positionsOf(circle());
    Eigen::Matrix3Xd mirrored = path;
    mirrored.row(0) *= -1;
    EXPECT_NEAR(alignPoints(path, mirrored).motion.R.determinant(), 1, 1e-12);
}

TEST(Alignment, refusesWhatDeterminesNothing) {
    const Eigen::Matrix3Xd one = Eigen::Matrix3Xd::Ones(3, 1);
    EXPECT_THROW(alignPoints(one, one), Error);
    const Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Ones(3, 20);
    EXPECT_THROW(alignPoints(still, still, AlignmentScale::Fitted), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
