/** Makes the maps of a finished run again, at other resolutions, without running SLAM. */
#include <cstdio>
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "rgbd_graphslam/mapping/scan_rawlog.h"
#include "rgbd_graphslam/report/run_report.h"
#include "rgbd_graphslam/semantics/semantic_maps.h"

using namespace rgbd_graphslam;

namespace {

struct Arguments {
    std::string folder, rawlog, destination;
    double octree_m = 0, grid_m = 0, points_m = 0, mesh_m = 0, z_min_m = 0, z_max_m = 0,
           scans_per_s = 0;
    std::vector<std::string> settings;
    bool upright = false;
};

/** What the command line says goes over what the run's config.ini says. */
MapOptions optionsOf(const CLI::App& app, const Arguments& arguments) {
    MapOptions options = readRunOptions(arguments.folder);
    IniFile overrides = IniFile::fromText("", "command line");
    const auto set = [&](const char* flag, const char* key, double value) {
        if (app.count(flag))
            overrides.override("MapOptions." + std::string(key) + "=" + std::to_string(value));
    };
    set("--octree", "octree_resolution_m", arguments.octree_m);
    set("--grid", "grid_resolution_m", arguments.grid_m);
    set("--points", "point_voxel_m", arguments.points_m);
    set("--mesh", "mesh_voxel_m", arguments.mesh_m);
    set("--z-min", "z_min_m", arguments.z_min_m);
    set("--z-max", "z_max_m", arguments.z_max_m);
    for (const auto& setting : arguments.settings) overrides.override(setting);
    overrides.load({&options});
    return options;
}

SemanticOptions semanticOptionsOf(const Arguments& arguments) {
    SemanticOptions options;
    const std::string config = arguments.folder + "/config.ini";
    if (std::filesystem::exists(config)) IniFile::fromFile(config).loadKnown({&options});
    return options;
}

void print(const MapSummary& summary, std::size_t scans, const std::string& folder) {
    std::printf(
        "keyframes      %zu\npoints         %zu\noctree leaves  %zu\ngrid           %d x %d "
        "cells\n",
        summary.keyframes, summary.points, summary.octree_leaves, summary.grid_width,
        summary.grid_height);
    if (summary.triangles > 0) std::printf("triangles      %zu\n", summary.triangles);
    if (scans > 0) std::printf("scans          %zu\n", scans);
    std::printf(
        "a keyframe     %.1f ms CPU\nmemory         %.1f MB: points %.1f, octree %.1f, mesh %.1f\n"
        "maps in        %s\n",
        summary.insert_ms, summary.megabytes, summary.points_megabytes, summary.octree_megabytes,
        summary.mesh_megabytes, folder.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app(
        "Makes the maps of a finished rgbd-slam run again, at other resolutions, without SLAM.",
        "rgbd-map");
    app.add_option("OUT", arguments.folder, "Output folder of rgbd-slam")->required();
    app.add_option("--octree", arguments.octree_m, "Resolution of the octree, m");
    app.add_option("--grid", arguments.grid_m, "Resolution of the 2-D grid, m");
    app.add_option("--points", arguments.points_m,
                   "Voxel that readings are merged in to one point, m");
    app.add_option("--mesh", arguments.mesh_m,
                   "Also write mesh.ply, of triangles with about this edge, m");
    app.add_option("--z-min", arguments.z_min_m,
                   "Obstacles of the grid start this high above the floor, m");
    app.add_option("--z-max", arguments.z_max_m,
                   "Obstacles of the grid end this high above the floor, m");
    app.add_option("--set", arguments.settings, "MapOptions.key=value, any other option");
    app.add_option("--rawlog", arguments.rawlog, "Where the rawlog is now, if it was moved");
    app.add_option("-o,--output", arguments.destination, "Folder for the maps (default: OUT)");
    app.add_flag("--upright", arguments.upright,
                 "Turn the poses upright first: for trajectories that are not of rgbd-slam");
    app.add_option("--scans", arguments.scans_per_s,
                   "Also write scans.rawlog for MRPT's pf-localization: level scans made of the "
                   "depth images, at most so many a second, and odometry made of the trajectory")
        ->check(CLI::PositiveNumber);
    declareExamples(app, {"rgbd-map out --octree 0.02", "rgbd-map out --mesh 0.02 -o fine"});
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        const MapOptions options = optionsOf(app, arguments);
        const std::string& folder =
            arguments.destination.empty() ? arguments.folder : arguments.destination;
        MapInputs inputs = readRunFolder(arguments.folder, arguments.rawlog);
        if (arguments.upright) inputs = transformed(T_gravity_world(inputs, options), inputs);
        const SemanticOptions semantics = semanticOptionsOf(arguments);
        inputs.moving_classes = semantics.moving_classes;
        const MapSummary summary = writeMaps(inputs, options, folder);
        removeSemanticMaps(folder);
        if (!semantics.model.empty() || hasLabels(arguments.folder)) {
            writeSemanticMaps(inputs, options, semantics, folder);
        }
        std::size_t scans = 0;
        if (arguments.scans_per_s > 0)
            scans = writeScans(inputs, options, arguments.scans_per_s, folder + "/scans.rawlog");
        if (std::filesystem::exists(arguments.folder + "/report.html")) {
            writeRunReport(arguments.folder, folder);
        }
        if (verbosity() != Verbosity::Quiet) print(summary, scans, folder);
        return 0;
    });
}
