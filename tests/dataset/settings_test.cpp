/** The ways to give rgbd-slam its settings lead to the same result. */
#include <gtest/gtest.h>

#include "../support/run_program.h"
#include "../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {

const std::string default_ini = "'" RGBD_SOURCE_DIR "/ini/default.ini'";
const std::string sample = "'" RGBD_SOURCE_DIR "/rawlogs/office_sample.rawlog'";

/** \return the output folder */
std::string slam(const TestFolder& folder, const std::string& name, const std::string& arguments) {
    const std::string out = folder / name;
    const ProgramResult result =
        runProgram("rgbd-slam", arguments + " --max-frames 40 -q -o '" + out + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return out;
}

TEST(Settings, builtInDefaultsAreThoseOfDefaultIni) {
    const TestFolder folder;
    const std::string without = slam(folder, "without", sample);
    const std::string config = slam(folder, "config", sample + " --config " + default_ini);
    const std::string earlier = slam(folder, "earlier", default_ini + " " + sample);
    for (const std::string file :
         {"trajectory.txt", "keyframes.txt", "frames.csv", "graph.graph", "config.ini",
          "map.sparse", "points.ply", "octree.bt", "octree.ot", "grid.gridmap.gz", "grid.png"}) {
        const std::string expected = readText(without + "/" + file);
        EXPECT_FALSE(expected.empty()) << file;
        EXPECT_TRUE(expected == readText(config + "/" + file)) << file;
        EXPECT_TRUE(expected == readText(earlier + "/" + file)) << file;
    }
}

TEST(Settings, anotherIniMakesAnotherTrajectory) {
    const TestFolder folder;
    folder.write("other.ini", "[FeatureOptions]\ncount = 500\n");
    const std::string other = slam(folder, "other", sample + " --config '" + folder / "other.ini'");
    const std::string without = slam(folder, "without", sample);
    EXPECT_FALSE(readText(without + "/trajectory.txt") == readText(other + "/trajectory.txt"));
}

}  // namespace
}  // namespace rgbd_graphslam
