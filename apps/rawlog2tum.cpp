/** rawlog2tum: the RGB-D frames of an MRPT rawlog become a TUM RGB-D sequence. */
#include <cstdio>
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/tum_export.h"

namespace rgbd_graphslam {
namespace {

struct Arguments {
    std::string rawlog, folder;
    ExportOptions options;
};

void declare(CLI::App& app, Arguments& args) {
    app.add_option("RAWLOG", args.rawlog, "Rawlog with RGB-D frames")->required();
    app.add_option("DIR", args.folder, "New folder for the sequence")->required();
    app.add_option("--sensor", args.options.sensor_label,
                   "Sensor label of the camera to export; default: all, one subfolder per camera")
        ->type_name("LABEL");
    app.add_option("--from", args.options.from_s, "Start this long after the first frame [s]")
        ->check(finite());
    app.add_option("--to", args.options.to_s, "End this long after the first frame [s]")
        ->check(finite());
    app.add_option("--every", args.options.every, "Export every n-th frame only")
        ->check(positive())
        ->capture_default_str();
    app.add_option("--rate", args.options.rate_hz,
                   "Frames per second of cameras whose frames have no timestamps")
        ->check(positive())
        ->capture_default_str();
    app.add_option("--threads", args.options.threads, "Threads that encode images")
        ->check(between(1, 256))
        ->capture_default_str();
    declareExamples(app, {"rawlog2tum office.rawlog office",
                          "rawlog2tum office.rawlog office --from 10 --to 20 --every 2"});
    declareCommonOptions(app);
}

int run(const Arguments& args) {
    for (const ExportReport& report : exportTumSequence(args.rawlog, args.folder, args.options)) {
        const std::string folder =
            report.subfolder.empty()
                ? ""
                : (std::filesystem::path(args.folder) / report.subfolder).string() + ": ";
        for (const std::string& note : report.notes) sayWarning(folder + note);
        std::printf(
            "%s%zu frames, %zu IMU readings, %zu odometry readings, %zu ground truth poses\n",
            folder.c_str(), report.frames, report.imu, report.odometry, report.truth);
    }
    return 0;
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    CLI::App app("Exports the RGB-D frames of an MRPT rawlog in the TUM RGB-D benchmark's layout",
                 "rawlog2tum");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(args); });
}
