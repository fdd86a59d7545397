#include "../../../libs/job/src/truth_comparison.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

SE3 turned(double yaw_rad, const Eigen::Vector3d& t) {
    SE3 pose;
    pose.R = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.t = t;
    return pose;
}

class EdgeBesideTheTruth : public testing::Test {
  protected:
    /** Of the edge from the pose at 0 s to the one at 0.1 s. */
    std::optional<double> errorM() const { return edgeErrorM(edge_, 0, 0.1, truth_); }

    Trajectory truth_ = {{0, turned(0.3, {1, 2, 3})}, {0.1, turned(-1.2, {-2, 0.5, 1})}};
    PoseEdge edge_ = {0, 1, truth_[0].T_world_cam.inverse() * truth_[1].T_world_cam};
};

TEST_F(EdgeBesideTheTruth, isRightWhereItMeasuresTheTrueMotion) {
    EXPECT_NEAR(*errorM(), 0, 1e-9);
}

TEST_F(EdgeBesideTheTruth, errorIsTheDistanceOfThePlacesOfTheSecondCamera) {
    edge_.T_from_to.t += Eigen::Vector3d(0.3, 0, 0.4);
    EXPECT_NEAR(*errorM(), 0.5, 1e-9);
}

TEST_F(EdgeBesideTheTruth, errorDoesNotDependOnTheWorldOfTheTruth) {
    edge_.T_from_to = edge_.T_from_to * turned(0.1, {0.03, 0.04, 0});
    const double error_m = errorM().value();
    EXPECT_NEAR(error_m, 0.05, 1e-9);
    for (StampedPose& pose : truth_) pose.T_world_cam = turned(2, {9, 8, 7}) * pose.T_world_cam;
    EXPECT_NEAR(*errorM(), error_m, 1e-9);
}

TEST_F(EdgeBesideTheTruth, errorIsUnknownWhereTheTruthHasNoPose) {
    EXPECT_FALSE(edgeErrorM(edge_, -1, 0.1, truth_));
    EXPECT_FALSE(edgeErrorM(edge_, 0, 0.2, truth_));
    truth_[1].stamp_s = 5;  // a gap
    EXPECT_FALSE(edgeErrorM(edge_, 0, 1, truth_));
}

}  // namespace
}  // namespace rgbd_graphslam
