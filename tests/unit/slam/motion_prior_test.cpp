#include "../../../libs/slam/src/motion_prior.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

using Source = MotionPrior::Source;

const SE3 ahead_1cm(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.01));

SE3 moved(double x_m, double turn_rad = 0) {
    return {rotationExp({0, turn_rad, 0}), Eigen::Vector3d(x_m, 0, 0)};
}

/** A robot that drives ahead 1 cm per frame, as its wheels measure with an error. */
class Drive {
  public:
    explicit Drive(double wheel_scale = 1) : wheel_scale_(wheel_scale) {}
    Frame next() {
        ++frames_;
        Frame frame;
        frame.stamp_s = frames_ / 30.0;
        frame.reckoning.T_odometry_cam =
            SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.01 * wheel_scale_ * frames_));
        return frame;
    }
    void track(MotionPrior& prior, int frames) {
        for (int i = 0; i < frames; ++i) prior.restart(next(), ahead_1cm);
    }
    void lose(MotionPrior& prior, int frames) {
        for (int i = 0; i < frames; ++i) prior.advance(next(), ahead_1cm, Source::Images);
    }

  private:
    double wheel_scale_;
    int frames_ = 0;
};

Frame withoutWheels(double stamp_s) {
    Frame frame;
    frame.stamp_s = stamp_s;
    return frame;
}

TEST(MotionPrior, isCertainOfNothingBeforeTheMapIsSeen) {
    const MotionPrior prior;
    EXPECT_EQ(prior.judge(moved(30, 3)), Agreement::Possible);
}

TEST(MotionPrior, wheelsConfirmOnePlaceAndContradictThoseBeside) {
    MotionPrior prior;
    Drive drive;
    drive.track(prior, 100);
    drive.lose(prior, 100);  // 1 m
    EXPECT_EQ(prior.judge(moved(0.05)), Agreement::Confirmed);
    EXPECT_EQ(prior.judge(moved(1.6)), Agreement::Contradicted);
    EXPECT_EQ(prior.judge(moved(0, 0.8)), Agreement::Contradicted);
}

TEST(MotionPrior, wheelsThatSlipContradictNothing) {
    MotionPrior prior;
    Drive drive(1.8);
    drive.track(prior, 500);
    EXPECT_FALSE(prior.wheelsTell(drive.next()));
    Drive good(1.05);
    MotionPrior of_good;
    good.track(of_good, 500);
    EXPECT_TRUE(of_good.wheelsTell(good.next()));
}

TEST(MotionPrior, wheelsThatLeapTellNothing) {
    MotionPrior prior;
    Frame before = withoutWheels(1), now = withoutWheels(1.03);
    before.reckoning.T_odometry_cam = SE3();
    now.reckoning.T_odometry_cam = moved(3);  // the driver began again
    prior.restart(before, SE3());
    EXPECT_FALSE(prior.wheelsTell(now));
    EXPECT_FALSE(prior.rulesOut(now, SE3()));
}

TEST(MotionPrior, withoutSensorsOnlyTimeBoundsTheMotion) {
    MotionPrior prior;
    prior.restart(withoutWheels(1), SE3());
    prior.advance(withoutWheels(1.1), SE3(), Source::None);
    EXPECT_EQ(prior.judge(moved(0.01)), Agreement::Possible);
    EXPECT_EQ(prior.judge(moved(2)), Agreement::Contradicted);
    prior.advance(withoutWheels(3), SE3(), Source::None);
    EXPECT_EQ(prior.judge(moved(2)), Agreement::Possible);
    EXPECT_EQ(prior.judge(moved(20)), Agreement::Contradicted);
}

TEST(MotionPrior, wheelsRuleOutThatADrivingRobotStandsStill) {
    MotionPrior prior;
    Drive drive(10);  // 10 cm per frame
    prior.restart(drive.next(), SE3());
    const Frame frame = drive.next();
    EXPECT_TRUE(prior.rulesOut(frame, SE3()));
    EXPECT_FALSE(prior.rulesOut(frame, {Eigen::Matrix3d::Identity(), {0, 0, 0.09}}));
    EXPECT_FALSE(prior.rulesOut(withoutWheels(2), SE3()));
}

TEST(MotionPrior, gyroscopeRulesOutThatATurningCameraLooksAhead) {
    MotionPrior prior;
    Frame before = withoutWheels(1), now = withoutWheels(1.03);
    before.reckoning.R_gyroscope_cam = Eigen::Matrix3d::Identity();
    now.reckoning.R_gyroscope_cam = rotationExp({0, 0.1, 0});
    prior.restart(before, SE3());
    EXPECT_TRUE(prior.rulesOut(now, SE3()));
    EXPECT_FALSE(prior.rulesOut(now, {rotationExp({0, 0.1, 0}), {0.3, 0, 0}}));
}

TEST(MotionPrior, goesOnAfterSaving) {
    MotionPrior prior, loaded;
    Drive drive;
    drive.track(prior, 77);
    drive.lose(prior, 5);
    ByteWriter out;
    prior.save(out);
    ByteReader in(out.bytes());
    loaded.load(in);
    drive.lose(prior, 7);
    Drive same;
    for (int i = 0; i < 82; ++i) same.next();
    same.lose(loaded, 7);
    EXPECT_EQ(prior.spread().m, loaded.spread().m);
    EXPECT_EQ(prior.spread().rad, loaded.spread().rad);
}

}  // namespace
}  // namespace rgbd_graphslam
