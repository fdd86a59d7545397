/** Drives a simulated robot through the saved map of a run: an example of navigation with MRPT. */
#include <cstdio>

#include "command_line.h"
#include "configured_input.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/installed_files.h"
#include "rgbd_graphslam/navigation/drive_job.h"

using namespace rgbd_graphslam;

int main(int argc, char** argv) {
    DriveRequest request;
    ConfiguredInput run;
    std::vector<double> start, goal;
    CLI::App app(
        "Plans a path through the map of a finished run and drives a simulated robot along it",
        "rgbd-drive");
    run.declare(app, "OUT", "Output folder of rgbd-slam",
                "Robot and settings (default: the shipped drive.ini)");
    app.add_option("--goal", goal, "Goal in the map frame [m]")
        ->delimiter(',')
        ->expected(2)
        ->required()
        ->check(finite());
    app.add_option(
           "--start", start,
           "Start in the map frame [m, m, rad] (default: the first camera's position and heading)")
        ->delimiter(',')
        ->expected(3)
        ->check(finite());
    app.add_option("--surface", request.surface,
                   "True surface (.ply) to check the driven path against, with --truth");
    app.add_option("--truth", request.truth,
                   "Ground-truth trajectory, which aligns the map with the true surface");
    app.add_option("-o,--output", request.out_folder,
                   "Folder for path.csv and drive.png (default: OUT)");
    app.add_option("--set", request.settings,
                   "Override a setting of [DriveOptions]; may be repeated");
    declareExamples(
        app, {"rgbd-drive out --goal 1.5,0.5",
              "rgbd-drive out --config robot.ini --start 0,0,1.57 --goal=-3.5,3.5 -o drive"});
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        request.run_folder = run.input();
        if (request.run_folder.empty())
            throw Error("missing argument OUT. Usage: rgbd-drive OUT --goal X,Y");
        request.ini = run.ini().empty() ? shippedIni("drive.ini") : run.ini();
        request.goal = {goal[0], goal[1]};
        if (!start.empty()) request.start = mrpt::math::TPose2D(start[0], start[1], start[2]);
        const DriveSummary summary = runDrive(request);
        if (verbosity() != Verbosity::Quiet) std::fputs(toText(summary).c_str(), stdout);
        return summary.good() ? 0 : 2;
    });
}
