/** rgbd-benchmark: import, SLAM and evaluation of all sequences in some folders, and one report. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/benchmark/benchmark_job.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

struct Arguments {
    BenchmarkRequest request;
    std::string share = "1/1";
    bool list = false, no_maps = false;
};

void declare(CLI::App& app, Arguments& args) {
    BenchmarkRequest& request = args.request;
    app.add_option("DIR", request.folders,
                   "Folders that hold sequences, their archives, bags or rawlogs, at any depth")
        ->required();
    app.add_option(
        "-o,--out", request.out_folder,
        "Folder for the results, report.html and report.md; finished sequences in it are "
        "skipped unless recording, settings or programs changed");
    app.add_option("--config", request.run.ini,
                   "Settings of rgbd-slam; default: the shipped ones for the camera");
    app.add_option("--set", request.run.assignments, "Override an ini setting; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--jobs", request.jobs,
                   "Sequences run at a time; 0: one per two processors and 2 GB of free memory")
        ->check(between(0, 1024))
        ->capture_default_str();
    app.add_option("--only", args.share,
                   "Run only the i-th of n shares of the sequences, to divide them among machines; "
                   "each writes the report over all finished sequences")
        ->capture_default_str();
    app.add_option("--table", request.table,
                   "Ini file of the best published figures; default: the shipped one");
    app.add_flag("--no-maps", args.no_maps, "Trajectories only");
    app.add_flag("--keep-rawlogs", request.run.keep_rawlog, "Keep the imported rawlogs");
    app.add_flag("--list", args.list, "Print the sequences found and exit");
    declareExamples(app, {"rgbd-benchmark ~/tum -o results",
                          "rgbd-benchmark ~/tum -o results --only 1/4 --no-maps"});
    declareCommonOptions(app);
}

int list(const Arguments& args, const Share& share) {
    const auto all = findSequences(args.request.folders, args.request.out_folder);
    for (const auto& [name, source] : shareOf(all, share)) {
        std::printf("%s\t%s\n", name.c_str(), source.c_str());
    }
    return 0;
}

int run(Arguments& args) {
    const Share share = parseShare(args.share);
    if (args.list) return list(args, share);
    if (args.request.out_folder.empty()) {
        throw Error("the output folder is missing", "call rgbd-benchmark DIR... -o OUT");
    }
    args.request.share = share;
    args.request.run.maps = !args.no_maps;
    const std::size_t failures = runBenchmark(args.request);
    const std::string report = args.request.out_folder + "/report.html";
    if (failures > 0) {
        throw Error(
            std::to_string(failures) + (failures == 1 ? " sequence" : " sequences") + " failed",
            "see '" + report + "'");
    }
    std::printf("%s\n", report.c_str());
    return 0;
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    CLI::App app("Imports, runs and evaluates many RGB-D sequences and writes one report",
                 "rgbd-benchmark");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(args); });
}
