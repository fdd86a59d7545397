#include "rgbd_graphslam/viewer/viewer_settings.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class Settings : public testing::Test {
  protected:
    ~Settings() override { fs::remove_all(folder_); }
    fs::path folder_ = fs::path(testing::TempDir()) / ("rgbd-settings-" + std::to_string(getpid()));
};

TEST_F(Settings, areRemembered) {
    const std::string path = (folder_ / "deep" / "viewer.ini").string();
    ViewerSettings settings;
    settings.window_width = 987;
    settings.octree = true;
    settings.colors = "height";
    saveSettings(path, settings);
    const ViewerSettings loaded = loadSettings(path);
    EXPECT_EQ(loaded.window_width, 987);
    EXPECT_TRUE(loaded.octree);
    EXPECT_EQ(loaded.colors, "height");
}

TEST_F(Settings, damagedOnesGiveWayToDefaults) {
    fs::create_directories(folder_);
    const std::string path = (folder_ / "viewer.ini").string();
    std::ofstream(path) << "[ViewerSettings]\nwindow_width = 700\noctree = maybe\n";
    testing::internal::CaptureStderr();
    const ViewerSettings loaded = loadSettings(path);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("viewer.ini:3"), std::string::npos);
    EXPECT_EQ(loaded.window_width, ViewerSettings().window_width);
    EXPECT_EQ(loadSettings("").window_width, ViewerSettings().window_width);
}

TEST_F(Settings, aPlaceThatCannotBeWrittenIsAWarning) {
    testing::internal::CaptureStderr();
    saveSettings("/proc/no/viewer.ini", ViewerSettings());
    EXPECT_NE(testing::internal::GetCapturedStderr().find("not kept"), std::string::npos);
}

TEST_F(Settings, liveWhereTheDesktopKeepsThem) {
    setenv("XDG_CONFIG_HOME", "/somewhere", 1);
    EXPECT_EQ(settingsPath(), "/somewhere/rgbd-graphslam/viewer.ini");
    unsetenv("XDG_CONFIG_HOME");
    setenv("HOME", "/home/someone", 1);
    EXPECT_EQ(settingsPath(), "/home/someone/.config/rgbd-graphslam/viewer.ini");
    unsetenv("HOME");
    EXPECT_EQ(settingsPath(), "");
}

}  // namespace
}  // namespace rgbd_graphslam
