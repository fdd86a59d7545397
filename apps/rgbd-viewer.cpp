/** Shows a run: in a window, or as a picture where there is none. */
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
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
    app.add_flag("--follow", args.job.follow,
                 "Watch the rgbd-slam that writes to OUT, now or soon; then show its result");
    app.add_option("--screenshot", args.job.screenshot,
                   "Open the window, write it to this PNG once all is shown, and end");
    app.add_option("--benchmark", args.job.benchmark_s,
                   "Open the window, measure the frame rate for so many seconds, and end")
        ->check(positive());
    auto* snapshot = app.add_option("--snapshot", args.snapshot,
                                    "PNG to write without a window; needs no display");
    const auto add = [&](const char* name, auto& value, const char* help) {
        return app.add_option(name, value, help)->needs(snapshot);
    };
    add("--width", args.view.width_px, "Pixels of the snapshot")->check(CLI::Range(16, 8192));
    add("--height", args.view.height_px, "Pixels of the snapshot")->check(CLI::Range(16, 8192));
    add("--azimuth", args.view.azimuth_deg, "Look from this direction, degrees from +x");
    add("--elevation", args.view.elevation_deg, "Look down from this angle, degrees")
        ->check(CLI::Range(-89, 90));
    add("--zoom", args.view.zoom, "Above 1 is nearer")->check(positive());
    app.add_flag("--mesh", args.as_mesh, "Show the mesh in the snapshot instead of the points")
        ->needs(snapshot);
    app.add_flag("--ceiling", args.with_ceiling, "Leave the ceiling on")->needs(snapshot);
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
    args.view.cut_ceiling = !args.with_ceiling;
    const PlyModel mesh = args.as_mesh ? meshOf(args.job.path) : PlyModel();
    renderSnapshot(loadScene(scenePath(args.job.path)), args.view, args.snapshot, mesh);
    sayInfo("wrote " + args.snapshot);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments args;
    CLI::App app("Shows a finished run in a window, press ? there for help; or renders its map.",
                 "rgbd-viewer");
    declare(app, args);
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] { return run(args); });
}
