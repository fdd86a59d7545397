/** SLAM with a stereo camera in a synthetic room, beside the same film by an RGB-D camera. */
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/synthetic_film.h"
#include "../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr int frames = 90;
const std::string settings = "--frames 90 --size 320x240";

nlohmann::json slamOf(const std::string& rawlog, const std::string& out,
                      const std::string& options) {
    runOrFail("rgbd-slam", "'" + rawlog + "' -o '" + out + "' -q " + options);
    return nlohmann::json::parse(std::ifstream(out + "/summary.json"));
}

std::string contentOf(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SlamOfAStereoCamera, isNearlyAsExactAsOfAnRgbdCamera) {
    const std::string stereo = filmOf("office", settings + " --camera stereo");
    const std::string depth = filmOf("office", settings);
    if (HasFatalFailure()) return;
    const TestFolder out;
    const auto by_stereo = slamOf(stereo + ".rawlog", out / "stereo", "");
    const auto by_depth = slamOf(depth + ".rawlog", out / "depth", "--no-maps");
    if (HasFatalFailure()) return;
    EXPECT_EQ(by_stereo["tracked"], frames);
    const double ate_m = by_stereo["ate"]["rmse_m"], other_m = by_depth["ate"]["rmse_m"];
    std::printf("ATE %.4f m, of an RGB-D camera %.4f m\n", ate_m, other_m);
    EXPECT_LE(ate_m, 1.5 * other_m + 0.002);
    for (const char* map : {"points.ply", "octree.bt", "grid.yaml", "report.html"}) {
        EXPECT_TRUE(fs::exists(out / ("stereo/" + std::string(map)))) << map;
    }
}

TEST(SlamOfAStereoCamera, isTheSameWithAnyNumberOfThreads) {
    const std::string film = filmOf("office", settings + " --camera stereo");
    if (HasFatalFailure()) return;
    const TestFolder out;
    for (const char* threads : {"1", "3"}) {
        slamOf(film + ".rawlog", out / threads,
               std::string("--no-maps --set RunOptions.threads=") + threads);
    }
    if (HasFatalFailure()) return;
    EXPECT_EQ(contentOf(out / "1/trajectory.txt"), contentOf(out / "3/trajectory.txt"));
}

}  // namespace
}  // namespace rgbd_graphslam
