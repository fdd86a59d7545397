/** The whole chain on synthetic sequences, whose truth is exact: rgbd-synth, tum2rawlog, rgbd-slam,
 *  rgbd-eval. Sequences are filmed once a build folder and kept there. */
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "../support/run_program.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

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

void runOrFail(const std::string& program, const std::string& arguments) {
    const ProgramResult result = runProgram(program, arguments);
    ASSERT_EQ(result.exit_code, 0) << program << " " << arguments << "\n" << result.err;
}

/** \return the sequence's folder; its rawlog lies beside it */
std::string film(const Scenario& scenario) {
    const std::string folder = std::string(RGBD_BINARY_DIR "/synthetic/") + scenario.name + "-" +
                               std::to_string(scenario.frames);
    const std::string rawlog = folder + ".rawlog";
    if (fs::exists(rawlog)) return folder;
    fs::remove_all(folder);
    fs::create_directories(fs::path(folder).parent_path());
    runOrFail("rgbd-synth", std::string(scenario.name) + " '" + folder + "' -q --frames " +
                                std::to_string(scenario.frames));
    runOrFail("tum2rawlog", "'" + folder + "' '" + rawlog + "' -q");
    return folder;
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
