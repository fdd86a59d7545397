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
    InertialUnit unit(world.motion, InertialModel{}, 1);
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

TEST(Inertial, BiasesWalkAndWarmUpAsToldAndTheSameWayEachTime) {
    Motion still;
    still.T_world_cam = [](double) { return SE3(); };
    InertialModel model{0, 0, 0, 0};
    model.force_walk = 0.01;
    model.rate_warming = 0.02;
    Vector6d last = Vector6d::Zero();
    double walked2 = 0;
    constexpr int seeds = 200, readings = 2000;
    for (int seed = 0; seed < seeds; ++seed) {
        InertialUnit unit(still, model, seed);
        for (int i = 0; i < readings; ++i) unit.read(i / 200.0, i);
        last = unit.bias();
        walked2 += last.head<3>().squaredNorm() / (3 * seeds);
        EXPECT_NEAR(last.tail<3>().norm(), 0.02 * (1 - std::exp(-(9.995 - 5) / 3)), 1e-9);
    }
    EXPECT_NEAR(std::sqrt(walked2), 0.01 * std::sqrt(10.0), 0.005);
    InertialUnit again(still, model, seeds - 1);
    for (int repeat = 0; repeat < 2; ++repeat) {
        for (int i = 0; i < readings; ++i) again.read(i / 200.0, i);
        EXPECT_EQ(again.bias(), last);
    }
}

TEST(Inertial, SaturatesAndIsLate) {
    const Motion motion = findScenario("desk").build(1, 1).motion;
    InertialModel model{0, 0, 0, 0};
    model.time_offset_s = 0.1;
    InertialUnit late(motion, model, 1);
    EXPECT_LT((late.read(1.1, 0).angular_rate - trueInertial(motion, 1).angular_rate).norm(), 1e-9);
    model.largest_force = 9;
    InertialUnit limited(motion, model, 1);
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
        largest = std::max(largest, limited.read(0.1 * i, i).specific_force.cwiseAbs().maxCoeff());
    }
    EXPECT_EQ(largest, 9);
}

TEST(Odometer, TellsOfLargerWheelsTooShortAWay) {
    const Motion motion = findScenario("long-run").build(1, 1).motion;
    WheelModel model{0, 0, 0, 0, 0};
    model.radius_error = 0.1;
    Odometer odometer(motion, model, 1);
    const Vector3d from = odometer.advance(0), to = odometer.advance(0.1);
    const SE3 moved = motion.T_world_base(0).inverse() * motion.T_world_base(0.1);
    EXPECT_NEAR((to - from).head<2>().norm(), 0.9 * moved.t.x(), 1e-6);
}

TEST(Odometer, SlipsInItsEpisodesOnly) {
    const Motion motion = findScenario("long-run").build(1, 1).motion;
    const SlipEpisode spin{2, 3, 2, 0.5};
    Odometer true_way(motion, {0, 0, 0, 0, 0}, 1), slipping(motion, {0, 0, 0, 0, 0}, 1, {spin});
    Vector3d a, b;
    for (int i = 0; i <= 40; ++i) {
        a = true_way.advance(0.05 * i);
        b = slipping.advance(0.05 * i);
    }
    EXPECT_LT((a - b).norm(), 1e-9) << "before";
    const Vector3d before = b;
    for (int i = 41; i <= 80; ++i) {
        a = true_way.advance(0.05 * i);
        b = slipping.advance(0.05 * i);
    }
    EXPECT_NEAR(std::remainder(b.z() - a.z(), 2 * M_PI), 0.5, 1e-6);
    EXPECT_GT((b - before).head<2>().norm(), 1.2);
}

TEST(Blackout, IsOverInTheSameFilmWithoutIt) {
    for (const char* name : {"blackout", "blackout-robot", "wheel-slip"}) {
        const World world = findScenario(name).build(1, 1), calm = withoutMovers(world);
        EXPECT_TRUE(!world.blackouts.empty() || !world.slips.empty());
        EXPECT_TRUE(calm.blackouts.empty() && calm.slips.empty());
        EXPECT_EQ(calm.motion.T_world_cam(4).t, world.motion.T_world_cam(4).t);
    }
}

}  // namespace
}  // namespace rgbd_graphslam::synth
