/** Maps, plans and drives as a user would, and measures the way against what was really there. */
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "../support/synthetic_film.h"

namespace rgbd_graphslam {
namespace {

struct Drive {
    const char *scenario, *film, *way;
    double least_path_m;
};

std::ostream& operator<<(std::ostream& out, const Drive& drive) {
    return out << drive.scenario;
}

double numberAfter(const std::string& name, const std::string& text) {
    const auto place = text.find(name);
    return place == std::string::npos ? -1 : std::stod(text.substr(place + name.size()));
}

class DriveThroughMap : public testing::TestWithParam<Drive> {};

TEST_P(DriveThroughMap, arrivesWithoutTouchingTheTrueSurface) {
    const std::string folder = filmOf(GetParam().scenario, GetParam().film);
    if (HasFatalFailure()) return;
    const TestFolder out;
    const std::string run = out / "run";
    runOrFail("rgbd-slam",
              "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + folder + ".rawlog' -o '" + run + "' -q");
    if (HasFatalFailure()) return;
    for (const char* follow : {"motion", "route"}) {
        const ProgramResult drive =
            runProgram("rgbd-drive", "'" + run + "' " + GetParam().way + " --surface '" + folder +
                                         "/surface.ply' --truth '" + folder +
                                         "/groundtruth.txt' --set DriveOptions.follow=" + follow +
                                         " -o '" + out / follow + "'");
        EXPECT_EQ(drive.exit_code, 0) << follow << "\n" << drive.out << drive.err;
        EXPECT_NE(drive.out.find("arrived        yes"), std::string::npos) << drive.out;
        EXPECT_GT(numberAfter("driven", drive.out), GetParam().least_path_m) << drive.out;
        EXPECT_GT(numberAfter("clearance", drive.out), 0) << drive.out;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Maps, DriveThroughMap,
    testing::Values(Drive{"office", "--size 320x240 --every 2",
                          "--start 0.6,-1.8,0 --goal 1.78,0.8", 2},
                    // From the corridor through a room into the next: two doors.
                    Drive{"corridor-loop", "--size 320x240 --every 3", "--goal=0.5,11", 15}),
    [](const auto& param_info) {
        return std::string(param_info.param.scenario) == "office" ? "office" : "corridorLoop";
    });

}  // namespace
}  // namespace rgbd_graphslam
