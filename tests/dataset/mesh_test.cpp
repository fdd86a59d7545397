/** The mesh of the sample rawlog, made as a user makes it: rgbd-slam, rgbd-map, rgbd-eval. */
#include <gtest/gtest.h>

#include "../support/synthetic_film.h"
#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {
namespace {

const std::string sample = RGBD_SOURCE_DIR "/rawlogs/office_sample.rawlog";

/** \return the output folder */
std::string slam(const TestFolder& folder, const std::string& name, const std::string& settings) {
    const std::string out = folder / name;
    runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + sample + "' -o '" + out +
                               "' -q " + settings);
    return out;
}

TEST(MeshOfSample, liesOnTheTrueSurface) {
    const std::string office = filmOf("office", "--frames 2");
    const TestFolder folder;
    const std::string out = slam(folder, "run", "--no-maps");
    runOrFail("rgbd-map", "'" + out + "' --mesh 0.02");
    if (HasFatalFailure()) return;
    const PlyModel mesh = readPly(out + "/mesh.ply");
    EXPECT_GT(mesh.triangles.size(), 50000u);
    EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
    const ProgramResult accuracy = runProgram(
        "rgbd-eval", "map '" + out + "/mesh.ply' '" + office + "/surface.ply' --estimate '" + out +
                         "/trajectory.txt' --truth '" + sample + "'");
    ASSERT_EQ(accuracy.exit_code, 0) << accuracy.err;
    const auto place = accuracy.out.find("median");
    ASSERT_NE(place, std::string::npos) << accuracy.out;
    EXPECT_LE(std::stod(accuracy.out.substr(place + 6)), 0.008) << accuracy.out;
}

TEST(MeshOfSample, doesNotDependOnThreads) {
    const TestFolder folder;
    const std::string settings = "--set MapOptions.mesh_voxel_m=0.04 --set RunOptions.threads=";
    const std::string one = slam(folder, "one", settings + "1");
    const std::string four = slam(folder, "four", settings + "4");
    if (HasFatalFailure()) return;
    const std::string mesh = readText(one + "/mesh.ply");
    EXPECT_GT(mesh.size(), 500000u);
    EXPECT_TRUE(mesh == readText(four + "/mesh.ply"));
}

}  // namespace
}  // namespace rgbd_graphslam
