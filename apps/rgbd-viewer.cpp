/** Shows a run: in a window, or as a picture where there is none. */
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "rgbd_graphslam/viewer/snapshot.h"
#include "rgbd_graphslam/viewer/viewer_app.h"

using namespace rgbd_graphslam;

namespace {

struct Arguments {
    ViewerJob job;
    std::string snapshot;
    ViewOptions view;
    bool with_ceiling = false, as_mesh = false;
};

void declare(CLI::App& app, Arguments& args) {
    app.add_option("OUT", args.job.path, "Output folder of rgbd-slam, or a .ply")->required();
    app.add_flag(
        "--follow", args.job.follow,
        "Follow the rgbd-slam that writes to OUT, running or about to start; then show its result");
    app.add_option("--screenshot", args.job.screenshot,
                   "Open the window, save it as this PNG once everything is shown, and quit");
    app.add_option("--benchmark", args.job.benchmark_s,
                   "Open the window, measure the frame rate for this many seconds, and quit")
        ->check(positive());
    auto* snapshot =
        app.add_option("--snapshot", args.snapshot,
                       "Render the map to this PNG without a window; needs no display");
    const auto add = [&](const char* name, auto& value, const char* help) {
        return app.add_option(name, value, help)->needs(snapshot);
    };
    add("--width", args.view.width_px, "Width of the snapshot [px]")->check(CLI::Range(16, 8192));
    add("--height", args.view.height_px, "Height of the snapshot [px]")
        ->check(CLI::Range(16, 8192));
    add("--azimuth", args.view.azimuth_deg, "Direction the camera looks from [deg from +x]");
    add("--elevation", args.view.elevation_deg, "Angle the camera looks down from [deg]")
        ->check(CLI::Range(-89, 90));
    add("--zoom", args.view.zoom, "Magnification; above 1 is closer")->check(positive());
    app.add_flag("--mesh", args.as_mesh, "Show the mesh in the snapshot instead of the points")
        ->needs(snapshot);
    app.add_flag("--ceiling", args.with_ceiling, "Keep the ceiling in the snapshot")
        ->needs(snapshot);
}

/** An output folder stands for its scene. */
std::string scenePath(const std::string& where) {
    namespace fs = std::filesystem;
    return fs::is_directory(where) ? (fs::path(where) / "scene.3Dscene").string() : where;
}

/** \throws Error when the folder has none */
PlyModel meshOf(const std::string& where) {
    namespace fs = std::filesystem;
    const fs::path path = fs::path(where) / "mesh.ply";
    if (!fs::exists(path))
        throw Error("there is no '" + path.string() + "'",
                    "make one with rgbd-map OUT --mesh 0.02");
    return readPly(path.string());
}

int run(Arguments& args) {
    if (args.snapshot.empty()) {
        runViewer(args.job);
        return 0;
    }
    args.view.cut_ceiling = !args.with_ceiling && !upIsGuessed(args.job.path);
    const PlyModel mesh = args.as_mesh ? meshOf(args.job.path) : PlyModel();
    renderSnapshot(loadScene(scenePath(args.job.path)), args.view, args.snapshot, mesh);
    sayInfo("wrote " + args.snapshot);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments args;
    CLI::App app(
        "Visualizes a finished or running SLAM session in a window (press ? there for help), or "
        "renders its map to a PNG.",
        "rgbd-viewer");
    declare(app, args);
    declareCommonOptions(app);
    declareExamples(app, {"rgbd-viewer out", "rgbd-viewer out --snapshot view.png"});
    return runProgram(app, argc, argv, [&] { return run(args); });
}
