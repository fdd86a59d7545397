#include "rgbd_graphslam/job/job_options.h"

#include <gtest/gtest.h>

#include "../../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {

const std::string ini_folder = RGBD_SOURCE_DIR "/ini/";

TEST(JobOptions, defaultIniIsWhatPrintConfigPrints) {
    EXPECT_TRUE(readText(ini_folder + "default.ini") == configText({}))
        << "renew it with: rgbd-slam --print-config > ini/default.ini";
}

class ShippedIni : public testing::TestWithParam<const char*> {};

TEST_P(ShippedIni, isAcceptedAndDiffersFromTheDefault) {
    JobOptions options;
    IniFile::fromFile(ini_folder + GetParam()).load(options.all());
    EXPECT_NE(configHash(options), configHash({}));
}

INSTANTIATE_TEST_SUITE_P(Names, ShippedIni,
                         testing::Values("tum_freiburg1.ini", "tum_freiburg2.ini",
                                         "tum_freiburg3.ini", "realsense_d435.ini"));

TEST(JobOptions, hashFollowsTheSettings) {
    JobOptions options;
    const std::string before = configHash(options);
    EXPECT_EQ(before.size(), 16u);
    options.slam.tracker.min_inliers += 1;
    EXPECT_NE(configHash(options), before);
}

}  // namespace
}  // namespace rgbd_graphslam
