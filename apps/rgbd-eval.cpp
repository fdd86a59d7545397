/** rgbd-eval: how good trajectories and maps are. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/evaluation/commands.h"
#include "rgbd_graphslam/evaluation/octree_accuracy.h"

namespace rgbd_graphslam {
namespace {

void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
}

void declareFormat(CLI::App& command, ReportFormat& format) {
    declareChoice(command, "--format", format,
                  {{"text", ReportFormat::Text},
                   {"csv", ReportFormat::Csv},
                   {"json", ReportFormat::Json},
                   {"latex", ReportFormat::Latex}},
                  "Output format");
}

void declareEstimates(CLI::App& command, TrajectoryRequest& request, EstimateOptions& options) {
    command
        .add_option("EST... TRUTH", request.files,
                    "Estimated trajectories, then the ground truth: TUM text files; the truth may "
                    "be a .rawlog")
        ->required()
        ->expected(2, CLI::detail::expected_max_vector_size);
    declareFormat(command, request.format);
    declareNumber(command, "--offset", options.offset_s, "Added to the stamps of the estimate [s]");
    declareNumber(command, "--scale", options.scale, "Factor on the positions of the estimate",
                  positive());
}

void declareTrajectories(CLI::App& command, TrajectoryRequest& request, EstimateOptions& options) {
    declareEstimates(command, request, options);
    command.add_flag("--per-axis", request.per_axis, "Also report the errors along x, y and z");
    command.add_option("--plot-errors", request.errors_plot,
                       "Plot the errors over time to this .png or .svg");
    command.add_option("--plot-distribution", request.distribution_plot,
                       "Plot the distribution of the errors to this .png or .svg");
}

void addAte(CLI::App& app, AteRequest& request) {
    auto& command = *app.add_subcommand("ate", "Absolute trajectory error");
    declareTrajectories(command, request, request.options);
    auto& options = request.options;
    declareNumber(command, "--max-difference", options.max_difference_s,
                  "Maximum time difference of a pair [s]", positive());
    command.add_flag("--fit-scale", options.fit_scale, "Align with the best-fitting scale")
        ->excludes("--scale");
    command.add_option("--plot", request.plot,
                       "Plot truth, estimate and difference to this .png or .svg");
    declareChoice(command, "--plane", request.plane,
                  {{"xy", PlotPlane::XY}, {"xz", PlotPlane::XZ}, {"yz", PlotPlane::YZ}},
                  "Plane of the plot, in the frame of the ground truth");
    command.final_callback([&request] { print(runAte(request)); });
}

void addRpe(CLI::App& app, RpeRequest& request) {
    auto& command = *app.add_subcommand("rpe", "Relative pose error");
    declareTrajectories(command, request, request.options);
    auto& options = request.options;
    command.add_flag("--fixed-delta", options.fixed_delta,
                     "Evaluate pairs of poses --delta apart instead of all pairs");
    declareNumber(command, "--delta", options.delta, "Distance between the two poses of a pair",
                  positive());
    declareChoice(command, "--delta-unit", options.unit,
                  {{"s", DeltaUnit::Seconds},
                   {"m", DeltaUnit::Meters},
                   {"rad", DeltaUnit::Radians},
                   {"deg", DeltaUnit::Degrees},
                   {"f", DeltaUnit::Frames}},
                  "Unit of --delta; f: frames");
    declareNumber(command, "--max-pairs", options.max_pairs,
                  "Maximum number of pairs, drawn at random; 0: all", notNegative());
    declareNumber(command, "--seed", options.seed, "Seed of the random draw", notNegative());
    command.final_callback([&request] { print(runRpe(request)); });
}

void addDrift(CLI::App& app, DriftRequest& request) {
    auto& command = *app.add_subcommand(
        "drift", "Error per length of the way, as the KITTI odometry benchmark has it");
    declareEstimates(command, request, request.options);
    auto& options = request.options;
    declareNumber(command, "--max-difference", options.max_difference_s,
                  "Stamps further apart are no pair, s", positive());
    command.add_flag("--fit-scale", options.fit_scale, "Use the scale that fits best")
        ->excludes("--scale");
    command
        .add_option("--lengths", options.lengths_m,
                    "Of the stretches that are compared, m; default: 100 to 800, or one to eight "
                    "ninths of a way shorter than 200 m")
        ->check(positive());
    command.final_callback([&request] { print(runDrift(request)); });
}

void addConsistency(CLI::App& app, ConsistencyRequest& request) {
    auto& command = *app.add_subcommand(
        "consistency",
        "Whether pose errors agree with the claimed standard deviations, and how far poses jump");
    command.add_option("RUN", request.run_folder, "Output folder of rgbd-slam")->required();
    command.add_option("TRUTH", request.truth, "Ground truth: TUM text file or .rawlog")
        ->required();
    declareNumber(command, "--truth-std-m", request.truth_std_m,
                  "Standard deviation of the ground truth's positions, m", notNegative());
    declareNumber(command, "--truth-std-deg", request.truth_std_deg,
                  "Standard deviation of the ground truth's rotations, degrees", notNegative());
    declareFormat(command, request.format);
    command.final_callback([&request] { print(runConsistency(request)); });
}

void addAssociate(CLI::App& app, AssociateRequest& request) {
    auto& command = *app.add_subcommand("associate", "Pair the lines of two lists by stamp");
    command.add_option("FILE1", request.first, "List, e.g. rgb.txt")->required();
    command.add_option("FILE2", request.second, "List, e.g. depth.txt")->required();
    auto& options = request.options;
    declareNumber(command, "--max-difference", options.max_difference_s,
                  "Maximum time difference of a pair [s]", positive());
    declareNumber(command, "--offset", options.offset_s,
                  "Added to the stamps of the second list [s]");
    command.add_flag("--first-only", options.first_only, "Print lines of the first list only");
    command.final_callback([&request] { print(runAssociate(request)); });
}

/** RGB DEPTH OUT, or OUT alone after --pairs. */
void takeFiles(const std::vector<std::string>& files, PointCloudRequest& request) {
    const std::size_t wanted = request.pairs.empty() ? 3 : 1;
    if (files.size() != wanted) {
        throw CLI::ValidationError("pointcloud", "give RGB DEPTH OUT.ply, or --pairs and OUT.ply");
    }
    request.output = files.back();
    if (wanted == 1) return;
    request.color = files[0];
    request.depth = files[1];
}

void addPointCloud(CLI::App& app, PointCloudRequest& request, std::vector<std::string>& files) {
    auto& command = *app.add_subcommand("pointcloud", "Colored points of RGB-D images");
    command
        .add_option("RGB DEPTH OUT.ply", files,
                    "Color and depth image, or with --trajectory lists of images; file to write")
        ->required()
        ->expected(1, 3);
    command.add_option("--trajectory", request.trajectory, "Poses of the images, a TUM text file");
    command.add_option("--pairs", request.pairs,
                       "List printed by 'rgbd-eval associate', in place of RGB and DEPTH");
    command
        .add_option("--camera", request.camera,
                    "fr1, fr2, fr3, ros or an ini file with [CAMERA_PARAMS]")
        ->capture_default_str();
    command
        .add_option("--depth-units", request.depth_units,
                    "Depth units per meter; default: the camera's")
        ->check(positive());
    declareNumber(command, "--max-difference", request.max_difference_s,
                  "Maximum time difference of a pair [s]", positive());
    declareNumber(command, "--nth", request.every_image, "Use every n-th image only", positive());
    auto& options = request.options;
    declareNumber(command, "--downsample", options.every_pixel,
                  "Use every n-th pixel of each row and column only", positive());
    declareNumber(command, "--max-depth", options.max_depth_m,
                  "Leave out readings beyond this depth [m]; 0: keep all", notNegative());
    declareNumber(command, "--voxel", options.voxel_m,
                  "Keep one point per voxel of this size [m]; 0: keep all", notNegative());
    command.final_callback([&] {
        takeFiles(files, request);
        print(runPointCloud(request));
    });
}

void declareAlignedMap(CLI::App& command, const std::string& map, SurfaceRequest& request) {
    command.add_option(map, request.map, "The map")->required();
    command.add_option("TRUE_SURFACE.ply", request.surface, "Triangles, or points close together")
        ->required();
    auto* estimate = command.add_option(
        "--estimate", request.estimate,
        "Trajectory of the map, which is aligned with --truth before the comparison");
    command.add_option("--truth", request.truth, "Ground truth, in the frame of the surface")
        ->needs(estimate);
    estimate->needs("--truth");
    declareFormat(command, request.format);
}

void declareSurface(CLI::App& command, const std::string& map, SurfaceRequest& request) {
    declareAlignedMap(command, map, request);
    command
        .add_option(
            "--camera", request.camera,
            "Name or ini file of the camera: also evaluate the surface that it saw on the true "
            "trajectory")
        ->needs("--truth");
    declareNumber(command, "--max-range", request.sight.max_range_m, "Range of the camera [m]",
                  positive());
    declareNumber(command, "--max-incidence", request.sight.max_incidence_deg,
                  "Maximum angle between viewing direction and surface normal [deg]", positive());
}

void addMap(CLI::App& app, MapRequest& request) {
    auto& command = *app.add_subcommand("map", "Accuracy and completeness of a map of points");
    declareSurface(command, "MAP.ply", request);
    auto& options = request.options;
    declareNumber(command, "--complete-within", options.completeness_distance_m,
                  "A part of the surface is covered by a map point nearer than this [m]",
                  positive());
    declareNumber(command, "--beyond", options.beyond_m,
                  "Report the share of points farther than this from the surface [m]", positive());
    command.add_option("--movers", request.movers,
                       "movers.csv of rgbd-synth: report their share where something moved");
    command.final_callback([&request] { print(runMap(request)); });
}

void addOctree(CLI::App& app, OctreeRequest& request) {
    auto& command = *app.add_subcommand("octree", "Accuracy of an octree: surface and free space");
    declareSurface(command, "OCTREE.bt", request);
    declareNumber(command, "--tolerance", request.tolerance_m,
                  "An occupied voxel this near to the surface counts as correct [m]",
                  notNegative());
    command.final_callback([&request] { print(runOctreeEvaluation(request)); });
}

void addGrid(CLI::App& app, GridRequest& request) {
    auto& command = *app.add_subcommand("grid", "Wrongly occupied cells of a 2-D grid");
    declareAlignedMap(command, "GRID.yaml", request);
    auto& options = request.options;
    declareNumber(command, "--tolerance", options.tolerance_m,
                  "A cell with an obstacle this near, seen from above, counts as correct [m]",
                  positive());
    declareNumber(command, "--z-min", options.min_z_m,
                  "Lower bound of obstacles, in the frame of the surface [m]");
    declareNumber(command, "--z-max", options.max_z_m, "Upper bound of obstacles [m]");
    command.add_option(
        "--movers", request.movers,
        "movers.csv of rgbd-synth: report how many of them are where something moved");
    command.final_callback([&request] { print(runGrid(request)); });
}

void addMasks(CLI::App& app, MasksRequest& request) {
    auto& command =
        *app.add_subcommand("masks", "Agreement of masks of moving objects with the truth");
    command.add_option("ESTIMATED_DIR", request.estimated, "Masks, PNG files named by stamp")
        ->required();
    command
        .add_option("TRUE_DIR", request.truth,
                    "True masks, e.g. movers/ of rgbd-synth, with movers.csv beside the folder")
        ->required();
    auto& options = request.options;
    declareNumber(command, "--min-share", options.min_share,
                  "Score images in which movers take up at least this share", notNegative());
    declareNumber(command, "--min-speed", options.min_speed_m_s,
                  "Score images whose fastest mover has at least this speed [m/s]", notNegative());
    declareNumber(command, "--max-difference", options.max_difference_s,
                  "Maximum time difference of a pair [s]", positive());
    declareFormat(command, request.format);
    command.final_callback([&request] { print(runMasks(request)); });
}

int run(int argc, char** argv) {
    CLI::App app("Evaluates RGB-D trajectories and maps as the TUM RGB-D benchmark does",
                 "rgbd-eval");
    app.require_subcommand(1);
    app.fallthrough();
    AteRequest ate;
    RpeRequest rpe;
    DriftRequest drift;
    ConsistencyRequest consistency;
    AssociateRequest association;
    PointCloudRequest cloud;
    std::vector<std::string> cloud_files;
    MapRequest map;
    addAte(app, ate);
    addRpe(app, rpe);
    addDrift(app, drift);
    addConsistency(app, consistency);
    addAssociate(app, association);
    addPointCloud(app, cloud, cloud_files);
    addMap(app, map);
    OctreeRequest octree;
    addOctree(app, octree);
    GridRequest grid;
    addGrid(app, grid);
    MasksRequest masks;
    addMasks(app, masks);
    declareExamples(app,
                    {"rgbd-eval ate out/trajectory.txt office.rawlog --plot ate.png",
                     "rgbd-eval rpe out/trajectory.txt groundtruth.txt --fixed-delta --delta 1",
                     "rgbd-eval drift out/trajectory.txt drive.rawlog"});
    declareCommonOptions(app);
    return runProgram(app, argc, argv);
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    return rgbd_graphslam::run(argc, argv);
}
