/** rgbd-slam: a rawlog or live sensors in, a folder with trajectory, graph and maps out. */
#include <cstdio>
#include <memory>

#include "command_line.h"
#include "configured_input.h"
#include "live_sensors.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {
namespace {

constexpr int limited_exit_code = 3;
constexpr int interrupted_exit_code = 130;

struct Arguments {
    ConfiguredInput rawlog;
    std::string out_folder, map_folder, resume_folder, sensor_label;
    std::string live_ini, record;
    std::vector<std::string> assignments;
    int threads = 0, max_frames = 0;
    double duration_s = 0;
    bool localize = false, extend = false;
    bool strict = false, no_maps = false, profile = false, view = false, print_config = false;
};

/** \return the options of live runs */
std::vector<CLI::Option*> declareLive(CLI::App& app, Arguments& args) {
    auto* const live = app.add_option("--live", args.live_ini,
                                      "Read the sensors of this ini file, as rawlog-grabber does, "
                                      "in place of a rawlog, until Ctrl-C")
                           ->type_name("INI");
    auto* const record =
        app.add_option("--record", args.record,
                       "With --live: write the rawlog here (default: OUT/record.rawlog, or none "
                       "with --no-maps)")
            ->type_name("RAWLOG")
            ->needs(live);
    auto* const duration =
        app.add_option("--duration", args.duration_s, "With --live: end after so many seconds")
            ->type_name("S")
            ->check(CLI::Range(0.1, 1e6).description(""))
            ->needs(live);
    return {live, record, duration};
}

void declare(CLI::App& app, Arguments& args) {
    args.rawlog.declare(app, "RAWLOG", "Rawlog with RGB-D frames",
                        "Settings (default: those of ini/default.ini)");
    auto* const out =
        app.add_option("-o,--out", args.out_folder, "Folder for the results, created if missing")
            ->type_name("DIR");
    auto* const map =
        app.add_option("--map", args.map_folder, "Start from the map in an earlier run's folder")
            ->type_name("DIR");
    auto* const localize = app.add_flag("--localize", args.localize,
                                        "With --map: localize every frame in it, unchanged");
    app.add_flag("--extend", args.extend, "With --map: extend it by what this rawlog shows")
        ->needs(map)
        ->excludes(localize);
    localize->needs(map);
    auto* const sensor =
        app.add_option("--sensor", args.sensor_label,
                       "Label of the only RGB-D camera to use where the rawlog has several "
                       "(default: all of them, as one rig)")
            ->type_name("LABEL");
    auto* const strict = app.add_flag(
        "--strict", args.strict,
        "Refuse a recording whose depth is not registered to color or not in the right units");
    auto* const set =
        app.add_option("--set", args.assignments, "Override an ini setting; may be repeated")
            ->allow_extra_args(false)
            ->type_name("SECTION.KEY=VALUE");
    app.add_option("--threads", args.threads, "As --set RunOptions.threads=N")->type_name("N");
    auto* const max_frames =
        app.add_option("--max-frames", args.max_frames, "As --set RunOptions.max_frames=N")
            ->type_name("N");
    auto* const no_maps =
        app.add_flag("--no-maps", args.no_maps, "As --set RunOptions.dense_maps=false");
    const auto of_live = declareLive(app, args);
    app.add_flag("--view", args.view,
                 "Watch the run in a window, as rgbd-viewer --follow OUT does");
    app.add_flag("--profile", args.profile, "Print the CPU time of each stage");
    app.add_flag("--print-config", args.print_config,
                 "Print all settings as a commented ini file and exit");
    auto* const resume =
        app.add_option("--resume", args.resume_folder,
                       "Resume the interrupted run in DIR from its last checkpoint, using its "
                       "settings and rawlog")
            ->type_name("DIR");
    for (auto* const other : args.rawlog.options()) resume->excludes(other);
    for (auto* const other : of_live) resume->excludes(other);
    for (auto* const other : {out, map, sensor, strict, set, max_frames, no_maps}) {
        resume->excludes(other);
    }
    declareExamples(app, {"rgbd-slam office.rawlog -o office",
                          "rgbd-slam desk.rawlog -o desk --config ini/realsense_d435.ini",
                          "rgbd-slam office2.rawlog -o office2 --map office --localize",
                          "rgbd-slam --live ini/live-openni2.ini -o now --view"});
    declareCommonOptions(app);
}

void overrideThreads(IniFile& ini, const CLI::App& app, const Arguments& args) {
    if (app.count("--threads")) ini.override("RunOptions.threads=" + std::to_string(args.threads));
}

JobOptions optionsOf(const CLI::App& app, const Arguments& args) {
    const std::string path = args.rawlog.ini();
    IniFile ini = path.empty() ? IniFile::fromText("", "") : IniFile::fromFile(path);
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

Error missingArgument(const std::string& name) {
    return Error("missing argument " + name + ". Usage: rgbd-slam RAWLOG -o OUT");
}

/** Where the rawlog of a live run is, if there is one. */
std::string recordOf(const Arguments& args) {
    if (!args.rawlog.input().empty()) {
        throw Error("both --live and the rawlog '" + args.rawlog.input() + "' are given",
                    "leave one of them out");
    }
    return args.record.empty() ? args.out_folder + "/record.rawlog" : args.record;
}

/** Starts the sensors and makes them the job's source. */
std::shared_ptr<void> startSensors(const Arguments& args, SlamJob& job) {
    if (args.live_ini.empty()) return nullptr;
    job.live =
        std::make_shared<LiveSource>(job.options.live, "the live input of '" + args.live_ini + "'");
    const bool for_maps = job.options.run.dense_maps && !job.localizes();
    if (for_maps || !args.record.empty()) job.live->recordTo(job.rawlog);
    if (args.duration_s > 0) job.live->endAfter(args.duration_s);
    return startLiveSensors(args.live_ini, job.live);
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
    const std::string rawlog = args.live_ini.empty() ? args.rawlog.input() : recordOf(args);
    if (rawlog.empty()) throw missingArgument("RAWLOG");
    if (args.out_folder.empty()) throw missingArgument("-o OUT");
    if (!args.map_folder.empty() && !args.localize && !args.extend) {
        throw Error("--map alone does not say what to do with it", "add --localize or --extend");
    }
    SlamJob job;
    job.rawlog = rawlog;
    job.out_folder = args.out_folder;
    job.options = options;
    job.map_folder = args.map_folder;
    job.map_use = args.extend ? MapUse::Extend : MapUse::Localize;
    job.view = args.view;
    job.sensor_label = args.sensor_label;
    job.strict = args.strict;
    return job;
}

int run(const CLI::App& app, const Arguments& args) {
    if (args.print_config) {
        std::fputs(configText(optionsOf(app, args)).c_str(), stdout);
        return 0;
    }
    SlamJob job = jobOf(app, args);
    const auto sensors = startSensors(args, job);
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
        "RGB-D SLAM on an MRPT rawlog or live sensors: trajectory, pose graph, points, octree, "
        "grid. Exit codes: 0 "
        "success (also of live sensors ended by Ctrl-C), 1 error, 3 stopped by max_keyframes or "
        "max_memory_mb, 130 Ctrl-C",
        "rgbd-slam");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(app, args); });
}
