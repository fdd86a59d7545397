#include "rgbd_graphslam/viewer/viewer_settings.h"

#include <cstdlib>
#include <filesystem>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

void ViewerSettings::describe(OptionVisitor& v) {
    constexpr int farthest = 1 << 15;
    v.integer("window_x", window_x, -farthest, farthest, "px",
              "Left edge of the window; -1 = free");
    v.integer("window_y", window_y, -farthest, farthest, "px", "Upper edge of the window");
    v.integer("window_width", window_width, 320, farthest, "px", "Width of the window");
    v.integer("window_height", window_height, 240, farthest, "px", "Height of the window");
    v.flag("points", points, "Colored points");
    v.flag("mesh", mesh, "Triangles of mesh.ply");
    v.flag("octree", octree, "Occupied cells of the octree");
    v.flag("free_space", free_space, "Free cells of the octree");
    v.flag("grid", grid, "2-D grid");
    v.flag("floor", floor, "Lines every meter on the floor");
    v.flag("trajectory", trajectory, "Estimated trajectory");
    v.flag("truth", truth, "True trajectory");
    v.flag("errors", errors, "Lines from estimated to true positions");
    v.flag("keyframes", keyframes, "Keyframes as view frustums");
    v.flag("covisibility", covisibility, "Edges between keyframes that see the same");
    v.flag("loops", loops, "Loop edges");
    v.flag("before_loops", before_loops, "Keyframes as they were without loops");
    v.flag("features", features, "Features in the image of a running SLAM");
    v.flag("view_panel", view_panel, "Panel of switches");
    v.flag("image_panel", image_panel, "Panel of images");
    v.flag("plot_panel", plot_panel, "Panel of plots");
    v.flag("time_panel", time_panel, "Panel of the time slider");
    v.flag("cut_ceiling", cut_ceiling, "Leave away what is above people's heads");
    v.choice("colors", colors, {"camera", "height"}, "Of points and octree");
    v.real("point_size_px", point_size_px, 1, 20, "px", "Least size of points");
}

std::string settingsPath() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    fs::path folder;
    if (config && *config) {
        folder = config;
    } else if (home && *home) {
        folder = fs::path(home) / ".config";
    } else {
        return {};
    }
    return (folder / "rgbd-graphslam" / "viewer.ini").string();
}

ViewerSettings loadSettings(const std::string& path) {
    ViewerSettings settings;
    if (path.empty() || !fs::exists(path)) return settings;
    try {
        IniFile::fromFile(path).load({&settings});
    } catch (const Error& e) {
        sayWarning(std::string(e.what()) + "; the viewer starts with its defaults");
        return {};
    }
    return settings;
}

void saveSettings(const std::string& path, ViewerSettings settings) {
    if (path.empty()) return;
    try {
        fs::create_directories(fs::path(path).parent_path());
        writeTextAtomically(path, toIniText({&settings}));
    } catch (const std::exception& e) {
        sayWarning(std::string("the viewer's settings are not kept: ") + e.what());
    }
}

}  // namespace rgbd_graphslam
