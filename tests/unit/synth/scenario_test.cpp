#include "rgbd_graphslam/synth/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/renderer.h"
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
        Renderer renderer(world.scene(), synthCamera(64, 48));
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
                                         "dark", "long-run"));

TEST(Scenario, TheListHoldsAllThatAreTested) {
    EXPECT_EQ(scenarios().size(), 10u);
}

TEST(Scenario, AnUnknownNameIsAnErrorThatListsTheNames) {
    try {
        findScenario("moon");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("corridor-loop"), std::string::npos);
    }
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
