#include "../../../libs/slam/src/pose_verdict.h"

#include <gtest/gtest.h>

#include "../../../libs/slam/src/pose_uncertainty.h"

namespace rgbd_graphslam {
namespace {

SE3 off(double m, double rad = 0) {
    return {rotationExp({0, rad, 0}), Eigen::Vector3d(m, 0, 0)};
}

Frame at(double stamp_s) {
    Frame frame;
    frame.stamp_s = stamp_s;
    return frame;
}

/** A camera that was seen at rest a thirtieth of a second ago. */
MotionPrior aFrameLater() {
    MotionPrior prior;
    prior.restart(at(1), SE3());
    prior.advance(at(1 + 1 / 30.0), SE3(), MotionPrior::Source::Inertia);
    return prior;
}

LocatedFrame locatedBy(int inliers, double sigma_m = 0.002, double sigma_rad = 0.001) {
    LocatedFrame located;
    located.inliers = inliers;
    located.information.diagonal().head<3>().setConstant(1 / (sigma_m * sigma_m));
    located.information.diagonal().tail<3>().setConstant(1 / (sigma_rad * sigma_rad));
    return located;
}

Verdict judge(const LocatedFrame& located, const SE3& T_predicted_cam, const MotionPrior& prior) {
    return judge(located, {T_predicted_cam, prior}, {T_predicted_cam, prior});
}

TEST(PoseVerdict, manyLandmarksOutrankWheelsThatLeap) {
    const SupposedMotion wheels{off(0.4), aFrameLater()}, inertia{off(0.01), aFrameLater()};
    EXPECT_EQ(judge(locatedBy(400), wheels, inertia), Verdict::Believed);
    EXPECT_EQ(judge(locatedBy(40), wheels, inertia), Verdict::Rejected);
}

TEST(PoseVerdict, noHandMovesACameraHalfAMeterInAFrame) {
    const MotionPrior prior = aFrameLater();
    EXPECT_EQ(judge(locatedBy(40), off(0.48), prior), Verdict::Rejected);
    EXPECT_EQ(judge(locatedBy(400), off(0.48), prior), Verdict::Rejected);
    EXPECT_EQ(judge(locatedBy(40), off(0.01), prior), Verdict::Believed);
    EXPECT_EQ(judge(locatedBy(400), off(0, 1), prior), Verdict::Rejected);
}

/** A camera that begins, or is found again, may be moving: what it did before is not known. */
TEST(PoseVerdict, aCameraMayStartInMotion) {
    MotionPrior prior;
    prior.restart(at(1), std::nullopt);
    prior.advance(at(1.1), SE3(), MotionPrior::Source::InertiaAlone);
    EXPECT_EQ(judge(locatedBy(40), off(1.1), prior), Verdict::Believed);
}

/** A car sees far, and moves as far in a frame as no hand does. */
TEST(PoseVerdict, lengthsAreThoseOfTheScene) {
    Frame street = at(1);
    street.keypoints.resize(9);
    for (Keypoint& k : street.keypoints) k.depth_m = 20;
    EXPECT_EQ(sceneScale(street), 5);
    MotionPrior prior;
    prior.restart(street, SE3());
    prior.advance(at(1.1), SE3(), MotionPrior::Source::InertiaAlone);
    EXPECT_EQ(judge(locatedBy(400, 0.02), off(1.2), prior), Verdict::Believed);
    EXPECT_EQ(judge(locatedBy(400, 0.02), off(12), prior), Verdict::Rejected);
}

TEST(PoseVerdict, fewLandmarksMustAgreeWithTheMotion) {
    const MotionPrior prior = aFrameLater();
    EXPECT_EQ(judge(locatedBy(40), off(0.16), prior), Verdict::Rejected);
    EXPECT_EQ(judge(locatedBy(400), off(0.16), prior), Verdict::Believed);
}

TEST(PoseVerdict, aDirectionThatIsOpenLeavesItUncertain) {
    LocatedFrame sliding = locatedBy(60);
    sliding.information(0, 0) = 1 / (0.1 * 0.1);
    EXPECT_EQ(judge(sliding, SE3(), aFrameLater()), Verdict::Uncertain);
    LocatedFrame turning = locatedBy(60);
    turning.information(4, 4) = 1 / (0.1 * 0.1);
    EXPECT_EQ(judge(turning, SE3(), aFrameLater()), Verdict::Uncertain);
}

/** The open direction is found though no axis shows it alone. */
TEST(PoseVerdict, theWeakestDirectionNeedNotBeAnAxis) {
    const Eigen::Vector3d along = Eigen::Vector3d(1, 1, 1).normalized();
    LocatedFrame sliding = locatedBy(60);
    sliding.information.topLeftCorner<3, 3>() -=
        (1 / (0.002 * 0.002) - 1 / (0.1 * 0.1)) * along * along.transpose();
    EXPECT_NEAR(weakestDirection(covarianceAgainstMap(sliding)).m /
                    weakestDirection(covarianceAgainstMap(locatedBy(60, 0.1))).m,
                1, 1e-3);
    EXPECT_EQ(judge(sliding, SE3(), aFrameLater()), Verdict::Uncertain);
}

TEST(PoseVerdict, afterLongSilenceMuchIsPossible) {
    MotionPrior prior;
    prior.restart(at(1), SE3());
    prior.advance(at(3), SE3(), MotionPrior::Source::None);
    EXPECT_EQ(judge(locatedBy(400), off(2), prior), Verdict::Believed);
}

}  // namespace
}  // namespace rgbd_graphslam
