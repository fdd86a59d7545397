/** rawlog2tum: the RGB-D frames of an MRPT rawlog become a TUM RGB-D sequence. */
#include <cstdio>

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
    app.add_option("DIR", args.folder, "Folder to make")->required();
    app.add_option("--from", args.options.from_s, "Leave out what is earlier, s after first frame");
    app.add_option("--to", args.options.to_s, "Leave out what is later, s after first frame");
    app.add_option("--every", args.options.every, "Every n-th frame")
        ->check(positive())
        ->capture_default_str();
    app.add_option("--threads", args.options.threads, "Threads that encode images")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    declareCommonOptions(app);
}

int run(const Arguments& args) {
    const ExportReport report = exportTumSequence(args.rawlog, args.folder, args.options);
    std::printf("%zu frames, %zu IMU readings, %zu odometry readings, %zu ground truth poses\n",
                report.frames, report.imu, report.odometry, report.truth);
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
