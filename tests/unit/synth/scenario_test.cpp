#include "rgbd_graphslam/synth/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/renderer.h"
#include "rgbd_graphslam/synth/robot_sensors.h"
#include "rgbd_graphslam/synth/sequence.h"

namespace rgbd_graphslam::synth {
namespace {

bool covered(const World& world, double t) {
    for (const auto& [from, to] : world.covered)
        if (t >= from - 0.05 && t < to + 0.05) return true;
    return false;
}

double speed(const Motion& motion, double t) {
    return (motion.T_world_cam(t + 0.01).t - motion.T_world_cam(t - 0.01).t).norm() / 0.02;
}

double turnRate(const Motion& motion, double t) {
    return (motion.T_world_cam(t - 0.01).inverse() * motion.T_world_cam(t + 0.01)).angle() / 0.02;
}

class EveryScenario : public testing::TestWithParam<const char*> {};

TEST_P(EveryScenario, MovesAsAPersonOrARobotDoes) {
    const Scenario& scenario = findScenario(GetParam());
    const bool hasty = scenario.name == "desk";
    for (int session = 1; session <= scenario.sessions; ++session) {
        const World world = scenario.build(session, 1);
        for (double t = 0; t < scenario.frames / 30.0; t += 0.05) {
            if (covered(world, t)) continue;
            ASSERT_LT(speed(world.motion, t), hasty ? 1.3 : 0.8) << "at " << t << " s";
            ASSERT_LT(turnRate(world.motion, t), hasty ? 2.3 : 1.05) << "at " << t << " s";
        }
    }
}

TEST_P(EveryScenario, KeepsClearOfTheFurnitureAndSeesSomething) {
    const Scenario& scenario = findScenario(GetParam());
    for (int session = 1; session <= scenario.sessions; ++session) {
        const World world = scenario.build(session, 1);
        Renderer renderer(withoutMovers(world).scene(), synthCamera(64, 48));
        const double end = std::min(scenario.frames / 30.0, world.motion.duration_s);
        for (double t = 0; t < end; t += end / 40) {
            if (covered(world, t)) continue;
            const cv::Mat depth = renderer.depth(world.motion.T_world_cam(t));
            double nearest = 0;
            cv::minMaxLoc(depth, &nearest, nullptr);
            ASSERT_GT(nearest, 0.2) << "at " << t << " s";  // 0 would be a hole in the room
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScenario,
                         testing::Values("office", "desk", "corridor-loop", "two-sessions",
                                         "kidnapped", "low-texture", "no-structure", "dynamic",
                                         "dark", "long-run", "crowd", "follow-me", "door",
                                         "chair-moved", "pushed-cart", "starts-in-crowd", "lift",
                                         "under-desk", "ceiling-lamp", "arm-in-view", "dirty-lens",
                                         "blackout", "blackout-robot", "wheel-slip",
                                         "glass-corridor"));

TEST(Scenario, TheListHoldsAllThatAreTested) {
    EXPECT_EQ(scenarios().size(), 25u);
}

TEST(Scenario, AnUnknownNameIsAnErrorThatListsTheNames) {
    try {
        findScenario("moon");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("corridor-loop"), std::string::npos);
    }
}

/** Share of the pixels that show figures, every half second. */
std::vector<double> maskedShares(const World& world, double seconds) {
    Renderer renderer(world.scene(), synthCamera(64, 48));
    std::vector<double> shares;
    for (double t = 0; t < seconds; t += 0.5) {
        for (std::size_t i = 0; i < world.movers.size(); ++i)
            renderer.placeFigure(static_cast<int>(i), world.movers[i].pose(t));
        const cv::Mat mask = renderer.labels(world.motion.T_world_cam(t)).mask;
        shares.push_back(cv::countNonZero(mask) / static_cast<double>(mask.total()));
    }
    return shares;
}

TEST(Crowd, TakesUpAFifthToFourFifthsOfTheView) {
    for (std::uint64_t seed : {1, 2}) {
        const auto shares = maskedShares(findScenario("crowd").build(1, seed), 10);
        EXPECT_GT(*std::min_element(shares.begin(), shares.end()), 0.15);
        EXPECT_LT(*std::max_element(shares.begin(), shares.end()), 0.85);
    }
}

TEST(FollowMe, HasThePeopleAlwaysInViewAtTheSameDistance) {
    const World world = findScenario("follow-me").build(1, 1);
    for (const double share : maskedShares(world, 10)) EXPECT_GT(share, 0.1);
    const auto distance = [&](double t) {
        return (world.movers[0].pose(t).t - world.motion.T_world_cam(t).t).head<2>().norm();
    };
    for (double t = 0; t < 10; t += 0.5) EXPECT_NEAR(distance(t), distance(0), 0.3);
}

TEST(PushedCart, StandsInViewIsPushedAndIsLeft) {
    const World world = findScenario("pushed-cart").build(1, 1);
    const auto shares = maskedShares(world, 4.5);
    EXPECT_GT(*std::min_element(shares.begin(), shares.end()), 0.03);
    const auto cart = world.movers.back().pose;
    EXPECT_TRUE(cart(0).t == cart(2.9).t);
    EXPECT_GT((cart(4).t - cart(2.9).t).norm(), 0.5);
    EXPECT_TRUE(cart(7).t == cart(9).t);
    EXPECT_EQ(cart(5).t.z(), 0);
}

TEST(WithoutMovers, TheCameraMovesTheSameAndNothingElseDoes) {
    for (const Scenario& scenario : scenarios()) {
        const World world = scenario.build(1, 1), calm = withoutMovers(world);
        for (double t : {0.0, 3.3, 7.7})
            EXPECT_TRUE(world.motion.T_world_cam(t).t == calm.motion.T_world_cam(t).t);
        EXPECT_TRUE(calm.movers.empty());
        EXPECT_FALSE(calm.lens);
    }
}

TEST(WithoutMovers, WhatRestsIsPartOfTheScene) {
    const World world = findScenario("door").build(1, 1);
    const Scene scene = world.scene(), calm = withoutMovers(world).scene();
    EXPECT_TRUE(calm.figures.empty());
    EXPECT_EQ(calm.quads.size(), scene.quads.size() + scene.figures[0].quads.size());
    EXPECT_EQ(calm.quads.back().label, Label::Door);
}

TEST(Scenario, EveryFigureHasAMover) {
    for (const Scenario& scenario : scenarios()) {
        const World world = scenario.build(1, 1);
        if (world.movers.empty()) continue;
        EXPECT_EQ(world.scene().figures.size(), world.movers.size()) << scenario.name;
    }
}

TEST(Lift, OnlyTheInertialSensorsFeelIt) {
    const World world = findScenario("lift").build(1, 1);
    EXPECT_LT(std::abs(world.motion.T_world_cam(5).t.z() - world.motion.T_world_cam(0).t.z()),
              1e-9);
    EXPECT_GT(trueInertial(world.motion, 2.5).specific_force.norm(), 9.81 + 0.2);
    EXPECT_NEAR(trueInertial(withoutMovers(world).motion, 2.5).specific_force.norm(), 9.81, 0.15);
}

TEST(CorridorLoop, IsSixtyMetresLongAndSeesItsStartAgain) {
    const Scenario& scenario = findScenario("corridor-loop");
    const Motion motion = scenario.build(1, 1).motion;
    double length = 0;
    for (int i = 1; i < scenario.frames; ++i)
        length += (motion.T_world_cam(i / 30.0).t - motion.T_world_cam((i - 1) / 30.0).t).norm();
    EXPECT_GT(length, 60);
    EXPECT_GT(scenario.frames / 30.0 - motion.duration_s, 2);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
