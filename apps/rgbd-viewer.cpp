/** Shows a finished run's map. */
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/viewer/snapshot.h"

using namespace rgbd_graphslam;

namespace {

/** An output folder stands for its scene. */
std::string scenePath(const std::string& where) {
    namespace fs = std::filesystem;
    return fs::is_directory(where) ? (fs::path(where) / "scene.3Dscene").string() : where;
}

}  // namespace

int main(int argc, char** argv) {
    std::string where, picture;
    ViewOptions view;
    bool with_ceiling = false;
    CLI::App app("Renders the map of a finished run.", "rgbd-viewer");
    app.add_option("OUT", where, "Output folder of rgbd-slam, or a .3Dscene")->required();
    app.add_option("--snapshot", picture, "PNG to write; needs no display")->required();
    app.add_option("--width", view.width_px, "Pixels")->check(CLI::Range(16, 8192));
    app.add_option("--height", view.height_px, "Pixels")->check(CLI::Range(16, 8192));
    app.add_option("--azimuth", view.azimuth_deg, "Look from this direction, degrees from +x");
    app.add_option("--elevation", view.elevation_deg, "Look down from this angle, degrees")
        ->check(CLI::Range(-89, 90));
    app.add_option("--zoom", view.zoom, "Above 1 is nearer")->check(CLI::PositiveNumber);
    app.add_flag("--ceiling", with_ceiling, "Leave the ceiling on");
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        view.cut_ceiling = !with_ceiling;
        renderSnapshot(loadScene(scenePath(where)), view, picture);
        sayInfo("wrote " + picture);
        return 0;
    });
}
