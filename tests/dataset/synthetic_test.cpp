/** The whole chain on synthetic sequences, whose truth is exact: rgbd-synth, rgbd-import,
 * rgbd-slam, rgbd-eval. */
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "../support/synthetic_film.h"

namespace rgbd_graphslam {
namespace {

struct Scenario {
    const char* name;
    int frames;
    double max_ate_m;
};

std::ostream& operator<<(std::ostream& out, const Scenario& scenario) {
    return out << scenario.name;
}

const Scenario scenarios[] = {
    {"office", 90, 0.010},      {"desk", 60, 0.010},         {"corridor-loop", 60, 0.010},
    {"low-texture", 60, 0.030}, {"no-structure", 60, 0.010}, {"dark", 60, 0.015},
};

std::string film(const Scenario& scenario) {
    return filmOf(scenario.name, "--frames " + std::to_string(scenario.frames));
}

class SlamOnSynthetic : public testing::TestWithParam<Scenario> {};

TEST_P(SlamOnSynthetic, staysOnTheTruth) {
    const std::string folder = film(GetParam());
    if (HasFatalFailure()) return;
    const TestFolder out;
    runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + folder + ".rawlog' -o '" +
                               out / "run" + "' -q --no-maps");
    if (HasFatalFailure()) return;
    const auto summary = nlohmann::json::parse(std::ifstream(out / "run/summary.json"));
    EXPECT_EQ(summary["tracked"], GetParam().frames);
    EXPECT_LE(summary["ate"]["rmse_m"].get<double>(), GetParam().max_ate_m);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, SlamOnSynthetic, testing::ValuesIn(scenarios),
                         [](const auto& param_info) {
                             std::string name = param_info.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(MapOfSynthetic, liesOnTheTrueSurface) {
    const std::string folder = film(scenarios[0]);
    if (HasFatalFailure()) return;
    const TestFolder out;
    runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + folder + ".rawlog' -o '" +
                               out / "run" + "' -q");
    if (HasFatalFailure()) return;
    const ProgramResult accuracy =
        runProgram("rgbd-eval", "map '" + out / "run/points.ply" + "' '" + folder +
                                    "/surface.ply' --estimate '" + out / "run/trajectory.txt" +
                                    "' --truth '" + folder + "/groundtruth.txt'");
    ASSERT_EQ(accuracy.exit_code, 0) << accuracy.err;
    const auto place = accuracy.out.find("median");
    ASSERT_NE(place, std::string::npos) << accuracy.out;
    EXPECT_LE(std::stod(accuracy.out.substr(place + 6)), 0.010) << accuracy.out;
}

}  // namespace
}  // namespace rgbd_graphslam
