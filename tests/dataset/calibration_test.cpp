/** rgbd-calibrate on a rendered board. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../support/synthetic_film.h"
#include "../support/tum_folder.h"
#include "rgbd_graphslam/dataset/camera_file.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

const std::string board = " --columns 10 --rows 7 --side 0.06";

TEST(Calibration, ofARenderedBoardIsThatOfTheRenderer) {
    const std::string film = filmOf("board", "--every 20");
    if (HasFatalFailure()) return;
    const TestFolder out;
    const ProgramResult result = runProgram(
        "rgbd-calibrate", "'" + film + ".rawlog' -o '" + out / "c" + "' --lens none" + board);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::printf("%s", result.out.c_str());
    const CameraSetup found = readCameraFile(out / "c/camera.ini");
    EXPECT_NEAR(found.camera.fx, 525, 0.525);
    EXPECT_NEAR(found.camera.fy, 525, 0.525);
    EXPECT_NEAR(found.camera.cx, 319.5, 1);
    EXPECT_NEAR(found.camera.cy, 239.5, 1);
    EXPECT_NEAR(found.depth_scale, 1, 1e-3);
    EXPECT_TRUE(std::filesystem::exists(out / "c/residuals.png"));

    const ProgramResult same = runProgram(
        "rgbd-calibrate", "'" + film + ".rawlog' --check '" + film + "/camera.ini'" + board);
    EXPECT_EQ(same.exit_code, 0) << same.out;
    CameraSetup wrong = readCameraFile(film + "/camera.ini");
    wrong.camera.fx *= 1.02;
    wrong.depth_scale = 1.03;
    std::ofstream(out / "wrong.ini") << toIniText(wrong);
    const ProgramResult other = runProgram(
        "rgbd-calibrate", "'" + film + ".rawlog' --check '" + out / "wrong.ini" + "'" + board);
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.out, HasSubstr("does NOT agree"));
}

TEST(Calibration, saysWhatItDidNotSee) {
    const std::string film = filmOf("board", "--every 20");
    if (HasFatalFailure()) return;
    const ProgramResult result = runProgram(
        "rgbd-calibrate", "'" + film + ".rawlog' --columns 8 --rows 5 --side 0.06");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("the board is seen in"));
}

}  // namespace
}  // namespace rgbd_graphslam
