/** SLAM through lenses: the pictures of a synthetic sequence as other lenses would have taken them.
 */
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <ostream>

#include "../support/synthetic_film.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/geometry/camera_model.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr int frames = 90;
constexpr double max_ate_m = 0.010;

/** Where in the pinhole's picture each pixel of another camera looks. */
cv::Mat2f lookupTable(const CameraModel& pinhole, const CameraModel& camera) {
    cv::Mat2f table(camera.height, camera.width);
    for (int v = 0; v < table.rows; ++v) {
        for (int u = 0; u < table.cols; ++u) {
            const Eigen::Vector2d from = pinhole.project(camera.bearing(Eigen::Vector2d(u, v)));
            table(v, u) = {static_cast<float>(from.x()), static_cast<float>(from.y())};
        }
    }
    return table;
}

/** Depth is along the axis, which lenses leave alone. */
void warpImages(const std::string& from, const std::string& to, const cv::Mat2f& table) {
    for (const char* kind : {"rgb", "depth"}) {
        fs::create_directories(fs::path(to) / kind);
        const int how = kind[0] == 'r' ? cv::INTER_CUBIC : cv::INTER_NEAREST;
        for (const auto& entry : fs::directory_iterator(fs::path(from) / kind)) {
            cv::Mat warped;
            cv::remap(cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED), warped, table, {},
                      how);
            cv::imwrite((fs::path(to) / kind / entry.path().filename()).string(), warped);
        }
    }
}

struct LensCase {
    const char* name;
    double focal_px;
    Lens lens;
};

void PrintTo(const LensCase& lens, std::ostream* out) {
    *out << lens.name;
}

class SlamThroughLenses : public ::testing::TestWithParam<LensCase> {};

/** A film as another lens would have taken it, in a folder with its calibration. */
void filmThrough(const LensCase& lens, const std::string& film, const std::string& to) {
    fs::create_directories(to);
    CameraSetup setup = readCameraFile(film + "/camera.ini");
    const CameraModel pinhole = setup.camera;
    setup.camera.fx = setup.camera.fy = lens.focal_px;
    setup.camera.lens = lens.lens;
    warpImages(film, to, lookupTable(pinhole, setup.camera));
    for (const auto& entry : fs::directory_iterator(film)) {
        if (entry.path().extension() == ".txt")
            fs::copy_file(entry.path(), fs::path(to) / entry.path().filename());
    }
    std::ofstream(to + "/camera.ini") << toIniText(setup);
}

TEST_P(SlamThroughLenses, isAsExactAsThroughAPinhole) {
    const std::string film = filmOf("office", "--frames 90 --size 320x240");
    if (HasFatalFailure()) return;
    const TestFolder folder;
    const std::string warped = folder / "warped";
    filmThrough(GetParam(), film, warped);
    const std::string rawlog = folder / "warped.rawlog";
    runOrFail("rgbd-import", "'" + warped + "' '" + rawlog + "' -q");
    if (HasFatalFailure()) return;
    runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + rawlog + "' -o '" +
                               folder / "run" + "' -q --no-maps");
    if (HasFatalFailure()) return;
    const auto summary = nlohmann::json::parse(std::ifstream(folder / "run/summary.json"));
    EXPECT_EQ(summary["tracked"], frames);
    EXPECT_LE(summary["ate"]["rmse_m"].get<double>(), max_ate_m);
    std::printf("%s: ATE %.4f m\n", GetParam().name, summary["ate"]["rmse_m"].get<double>());
}

INSTANTIATE_TEST_SUITE_P(
    All, SlamThroughLenses,
    ::testing::Values(LensCase{"none", 262.5, {}},
                      LensCase{"rational", 280,
                               BrownLens{{0.52, -2.74, 0.0004, -0.0003, 1.59, 0.40, -2.55, 1.51}}},
                      LensCase{"strongRational", 320,
                               BrownLens{{0.9, 0.35, 0.002, -0.001, 0.02, 1.25, 0.55, 0.08}}},
                      LensCase{"kannalaBrandt", 310,
                               KannalaBrandtLens{{-0.0027, 0.0387, -0.0365, 0.0062}}}),
    [](const auto& param_info) { return param_info.param.name; });

/** What the import says to a calibration with or without the lens. */
std::string importWarnings(const std::string& film, bool lens_known) {
    const TestFolder folder;
    const std::string warped = folder / "warped";
    filmThrough({"barrel", 290, BrownLens{{-0.2}}}, film, warped);
    if (!lens_known) {
        CameraSetup setup = readCameraFile(warped + "/camera.ini");
        setup.camera.lens = {};
        std::ofstream(warped + "/camera.ini") << toIniText(setup);
    }
    const ProgramResult result =
        runProgram("rgbd-import", "'" + warped + "' '" + folder / "warped.rawlog" + "'");
    EXPECT_EQ(result.exit_code, 0);
    return result.err;
}

TEST(ImportThroughALens, aMissingLensIsNamed) {
    const std::string film = filmOf("office", "--frames 90 --size 320x240");
    if (HasFatalFailure()) return;
    const std::string unknown = importWarnings(film, false);
    EXPECT_NE(unknown.find("lens with k1 = -0."), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("'dist' in camera.ini"), std::string::npos) << unknown;
    EXPECT_EQ(importWarnings(film, true).find("lens with k1"), std::string::npos);
}

}  // namespace
}  // namespace rgbd_graphslam
