/** rgbd-slam: a rawlog in, a folder with trajectory, graph and maps out. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/graphslam/slam_job.h"

namespace rgbd_graphslam {
namespace {

constexpr int limited_exit_code = 3;
constexpr int interrupted_exit_code = 130;

struct Arguments {
    std::string ini, rawlog, out_folder, map_folder, resume_folder;
    std::vector<std::string> assignments;
    int threads = 0, max_frames = 0;
    bool localize = false, extend = false;
    bool no_maps = false, profile = false, view = false, print_config = false;
};

void declare(CLI::App& app, Arguments& args) {
    auto* const ini = app.add_option("INI", args.ini, "Settings, e.g. ini/default.ini");
    auto* const rawlog = app.add_option("RAWLOG", args.rawlog, "Rawlog with RGB-D frames");
    auto* const out =
        app.add_option("-o,--out", args.out_folder, "Folder for the results, made where missing");
    auto* const map =
        app.add_option("--map", args.map_folder, "Start from the map of an earlier run's folder");
    auto* const localize = app.add_flag("--localize", args.localize,
                                        "With --map: find every frame in it, leave it as it is");
    app.add_flag("--extend", args.extend, "With --map: add what this rawlog shows to it")
        ->needs(map)
        ->excludes(localize);
    localize->needs(map);
    auto* const set = app.add_option("--set", args.assignments,
                                     "Section.key=value instead of the ini's; repeatable")
                          ->allow_extra_args(false);
    app.add_option("--threads", args.threads, "As --set RunOptions.threads=N");
    auto* const max_frames =
        app.add_option("--max-frames", args.max_frames, "As --set RunOptions.max_frames=N");
    auto* const no_maps =
        app.add_flag("--no-maps", args.no_maps, "As --set RunOptions.dense_maps=false");
    app.add_flag("--view", args.view, "Watch the run in a window; as rgbd-viewer --follow OUT");
    app.add_flag("--profile", args.profile, "Print the times of all stages");
    app.add_flag("--print-config", args.print_config,
                 "Print all settings as a commented ini, then stop");
    auto* const resume =
        app.add_option("--resume", args.resume_folder,
                       "Go on with the killed or interrupted run in this folder from its last "
                       "checkpoint, with its settings and its rawlog; the result is that of a run "
                       "never ended");
    for (auto* const other : {ini, rawlog, out, map, set, max_frames, no_maps}) {
        resume->excludes(other);
    }
    declareCommonOptions(app);
}

void overrideThreads(IniFile& ini, const CLI::App& app, const Arguments& args) {
    if (app.count("--threads")) ini.override("RunOptions.threads=" + std::to_string(args.threads));
}

JobOptions optionsOf(const CLI::App& app, const Arguments& args) {
    IniFile ini = args.ini.empty() ? IniFile::fromText("", "") : IniFile::fromFile(args.ini);
    for (const std::string& assignment : args.assignments) ini.override(assignment);
    overrideThreads(ini, app, args);
    if (app.count("--max-frames")) {
        ini.override("RunOptions.max_frames=" + std::to_string(args.max_frames));
    }
    if (args.no_maps) ini.override("RunOptions.dense_maps=false");
    JobOptions options;
    ini.load(options.all());
    return options;
}

SlamJob jobOf(const CLI::App& app, const Arguments& args) {
    if (!args.resume_folder.empty()) {
        SlamJob job = resumedJob(args.resume_folder);
        IniFile changes = IniFile::fromText("", "");
        overrideThreads(changes, app, args);
        changes.load(job.options.all());
        job.view = args.view;
        return job;
    }
    const JobOptions options = optionsOf(app, args);
    if (args.rawlog.empty() || args.out_folder.empty()) {
        throw Error("the rawlog or the output folder is missing",
                    "call rgbd-slam INI RAWLOG -o OUT, see --help");
    }
    if (!args.map_folder.empty() && !args.localize && !args.extend) {
        throw Error("--map alone does not say what to do with it", "add --localize or --extend");
    }
    return {args.rawlog,
            args.out_folder,
            options,
            args.map_folder,
            args.extend ? MapUse::Extend : MapUse::Localise,
            args.view};
}

int run(const CLI::App& app, const Arguments& args) {
    if (args.print_config) {
        std::fputs(configText(optionsOf(app, args)).c_str(), stdout);
        return 0;
    }
    const SlamJob job = jobOf(app, args);
    const JobReport report = runSlamJob(job);
    if (args.profile) std::fputs((profileTable(report) + "\n").c_str(), stdout);
    std::fputs(resultTable(job, report).c_str(), stdout);
    if (!report.damage.empty()) throw Error(report.damage);
    if (report.interrupted) return interrupted_exit_code;
    return report.limit.empty() ? 0 : limited_exit_code;
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    CLI::App app(
        "RGB-D SLAM on an MRPT rawlog: trajectory, pose graph, points, octree, grid. Ends "
        "with 3 when a limit on keyframes or memory, 130 when Ctrl-C ended it early",
        "rgbd-slam");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(app, args); });
}
