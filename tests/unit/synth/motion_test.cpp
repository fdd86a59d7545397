#include "rgbd_graphslam/synth/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rgbd_graphslam/synth/robot_sensors.h"
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {
namespace {

using Eigen::Vector3d;

TEST(Spline, VelocityIsTheDerivative) {
    const Spline spline({{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {2, -1, 0}, {0, -2, 1}}, 0.7, true);
    for (double t : {0.1, 0.7, 1.5, 3.3, 9.9}) {
        const Vector3d slope = (spline.at(t + 1e-5) - spline.at(t - 1e-5)) / 2e-5;
        EXPECT_LT((slope - spline.velocity(t)).norm(), 1e-6);
    }
    EXPECT_LT((spline.at(0.3) - spline.at(0.3 + spline.duration())).norm(), 1e-12);
}

TEST(EvenlySpaced, StaysOnThePolylineAtEqualDistances) {
    const auto points = evenlySpaced({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 0.5, true);
    ASSERT_EQ(points.size(), 12u);
    EXPECT_LT((points[4] - Vector3d(2, 0, 0)).norm(), 1e-12);
    EXPECT_LT((points[11] - Vector3d(0, 0.5, 0)).norm(), 1e-12);
}

TEST(LookingAt, PutsTheTargetInTheMiddleWithALevelHorizon) {
    const SE3 pose = lookingAt({1, 2, 1.5}, {3, 1, 1});
    const Vector3d seen = pose.inverse() * Vector3d(3, 1, 1);
    EXPECT_NEAR(seen.x(), 0, 1e-12);
    EXPECT_NEAR(seen.y(), 0, 1e-12);
    EXPECT_GT(seen.z(), 0);
    EXPECT_NEAR(pose.R(2, 0), 0, 1e-12);  // x axis is level
    EXPECT_LT(pose.R(2, 1), 0);           // y axis points down
    EXPECT_NEAR(pose.R.determinant(), 1, 1e-12);
}

TEST(Inertial, AtRestItFeelsGravityUpwards) {
    Motion still;
    still.T_world_cam = [](double) { return lookingAt({0, 0, 1}, {1, 0.3, 0.8}); };
    const InertialReading reading = trueInertial(still, 1);
    const Vector3d in_world = still.T_world_cam(1).R * reading.specific_force;
    EXPECT_LT((in_world - Vector3d(0, 0, 9.81)).norm(), 1e-6);
    EXPECT_LT(reading.angular_rate.norm(), 1e-9);
}

TEST(Inertial, MeanForceOfAScenarioIsGravity) {
    const World world = findScenario("office").build(1, 1);
    const InertialUnit unit(world.motion, InertialModel{}, 1);
    Vector3d mean(0, 0, 0);
    const int count = 3000;
    for (int i = 0; i < count; ++i) {
        const double t = i * world.motion.duration_s / count;
        mean += world.motion.T_world_cam(t).R * unit.read(t, i).specific_force / count;
    }
    EXPECT_NEAR(mean.z(), 9.81, 0.15);  // the constant bias turns with the camera
    EXPECT_NEAR(mean.head<2>().norm(), 0, 0.15);
}

TEST(Inertial, IntegratedRatesGiveTheTurn) {
    const Motion motion = findScenario("desk").build(1, 1).motion;
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    const double step = 1e-3;
    for (int i = 0; i < 2000; ++i)
        turned = turned * rotationExp(step * trueInertial(motion, (i + 0.5) * step).angular_rate);
    const Eigen::Matrix3d truth = motion.T_world_cam(0).R.transpose() * motion.T_world_cam(2).R;
    EXPECT_LT(rotationLog(turned.transpose() * truth).norm(), 1e-3);
}

TEST(Inertial, ForcesIntegrateToTheWay) {
    const Motion motion = findScenario("office").build(1, 1).motion;
    const double step = 1e-3;
    Vector3d velocity = (motion.T_world_cam(1e-4).t - motion.T_world_cam(-1e-4).t) / 2e-4;
    Vector3d position = motion.T_world_cam(0).t;
    for (int i = 0; i < 2000; ++i) {
        const double t = (i + 0.5) * step;
        const Vector3d acceleration =
            motion.T_world_cam(t).R * trueInertial(motion, t).specific_force - Vector3d(0, 0, 9.81);
        position += step * velocity + 0.5 * step * step * acceleration;
        velocity += step * acceleration;
    }
    EXPECT_LT((position - motion.T_world_cam(2).t).norm(), 1e-3);
}

TEST(Odometer, WithoutErrorsItFollowsTheRobot) {
    const Motion motion = findScenario("long-run").build(1, 1).motion;
    Odometer odometer(motion, {0, 0, 0, 0, 0}, 1);
    Vector3d pose(0, 0, 0);
    for (int i = 0; i <= 1000; ++i) pose = odometer.advance(i * 0.02);
    EXPECT_LT((pose.head<2>() - motion.T_world_base(20).t.head<2>()).norm(), 5e-3);
}

TEST(Odometer, DriftsBySomePerCentOfTheWay) {
    const Motion motion = findScenario("long-run").build(1, 1).motion;
    Odometer odometer(motion, WheelModel{}, 1);
    Vector3d pose(0, 0, 0);
    for (int i = 0; i <= 800; ++i) pose = odometer.advance(i * 0.05);
    const double drift = (pose.head<2>() - motion.T_world_base(40).t.head<2>()).norm();
    EXPECT_GT(drift, 0.02);
    EXPECT_LT(drift, 3);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
