/** A camera that sees nothing for two seconds in the hand, and for five on a robot. */
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../support/synthetic_film.h"

namespace rgbd_graphslam {
namespace {

struct BlackoutCase {
    const char* scenario;
    const char* settings;
    double max_ate_m;
    /** Of a neighbor, 0.1 s away. */
    double longest_step_m;
};

void PrintTo(const BlackoutCase& blackout, std::ostream* out) {
    *out << blackout.scenario;
}

/** The longest way between neighboring poses of a trajectory in TUM's format. */
double longestStep(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    double longest = 0;
    for (bool first = true; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream numbers(line);
        double stamp_s = 0;
        Eigen::Vector3d at;
        numbers >> stamp_s >> at.x() >> at.y() >> at.z();
        if (!first) longest = std::max(longest, (at - last).norm());
        last = at;
        first = false;
    }
    return longest;
}

class Blackout : public testing::TestWithParam<BlackoutCase> {};

TEST_P(Blackout, isCrossedWithoutAJump) {
    const std::string film = filmOf(GetParam().scenario, GetParam().settings);
    if (HasFatalFailure()) return;
    const TestFolder folder;
    const std::string run = folder / "run";
    runOrFail("rgbd-slam", "'" + film + ".rawlog' -o '" + run + "' -q --no-maps");
    const auto summary = nlohmann::json::parse(std::ifstream(run + "/summary.json"));
    std::printf("%s: ATE %.4f m, %d dead-reckoned, longest step %.3f m\n", GetParam().scenario,
                summary["ate"]["rmse_m"].get<double>(), summary["dead_reckoned"].get<int>(),
                longestStep(run + "/trajectory.txt"));
    EXPECT_EQ(summary["lost"], 0);
    EXPECT_GE(summary["dead_reckoned"], 18);
    EXPECT_LE(summary["ate"]["rmse_m"].get<double>(), GetParam().max_ate_m);
    EXPECT_LE(longestStep(run + "/trajectory.txt"), GetParam().longest_step_m);
    EXPECT_TRUE(summary["motion"]["imu"]["used"]);
    EXPECT_NEAR(summary["motion"]["imu"]["rate_hz"].get<double>(), 200, 1);
}

INSTANTIATE_TEST_SUITE_P(
    All, Blackout,
    testing::Values(BlackoutCase{"blackout", "--session 1 --frames 540 --every 3 --size 320x240",
                                 0.03, 0.09},
                    BlackoutCase{"blackout-robot",
                                 "--session 2 --frames 840 --every 3 --size 320x240", 0.04, 0.09}));

}  // namespace
}  // namespace rgbd_graphslam
