/** What the viewer remembers from one time to the next. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[ViewerSettings]` of viewer.ini. */
struct ViewerSettings : Options {
    int window_x = -1, window_y = -1, window_width = 1280, window_height = 800;
    bool points = true, mesh = false, octree = false, free_space = false, grid = false,
         floor = true, trajectory = true;
    bool truth = true, errors = false, keyframes = true, covisibility = false, loops = true;
    bool before_loops = false, features = true;
    bool view_panel = true, image_panel = true, plot_panel = true, time_panel = true;
    bool cut_ceiling = true;
    std::string colors = "camera";
    double point_size_px = 2;

    const char* section() const override { return "ViewerSettings"; }
    const char* about() const override { return "Window and switches of rgbd-viewer"; }
    void describe(OptionVisitor& v) override;
};

/** `rgbd-graphslam/viewer.ini` in $XDG_CONFIG_HOME or else in ~/.config; empty when neither
 *  variable is set. */
std::string settingsPath();

/** Defaults when there is no file; with a warning when it is damaged. */
ViewerSettings loadSettings(const std::string& path);

/** Warns when the file cannot be written. */
void saveSettings(const std::string& path, ViewerSettings settings);

}  // namespace rgbd_graphslam
