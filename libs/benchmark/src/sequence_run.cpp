#include "rgbd_graphslam/benchmark/sequence_run.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rgbd_graphslam/benchmark/child_process.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/installed_files.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/evaluation/plots.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** FNV-1a, 64 bit. */
class Hash {
  public:
    void add(const char* bytes, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            value_ = (value_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3;
        }
    }
    void add(const std::string& text) { add(text.c_str(), text.size() + 1); }
    void addContent(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        char block[1 << 16];
        while (in.read(block, sizeof block) || in.gcount() > 0) {
            add(block, static_cast<std::size_t>(in.gcount()));
        }
    }
    /** Name, size and time of a file stand for its content. */
    void addState(const fs::path& path) {
        add(path.string());
        add(std::to_string(fs::last_write_time(path).time_since_epoch().count()));
        if (fs::is_regular_file(path)) add(std::to_string(fs::file_size(path)));
    }
    std::string text() const {
        char digits[20];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value_));
        return digits;
    }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

std::string iniFor(const FoundSequence& sequence, const SequenceRunOptions& options) {
    if (!options.ini.empty()) return options.ini;
    const auto camera = cameraByFolderName(fs::path(sequence.source).filename());
    return shippedIni(camera ? "tum_freiburg" + camera->name.substr(2) + ".ini" : "default.ini");
}

void require(const ChildResult& child, const std::string& program) {
    if (child.good()) return;
    const std::string said = child.last_line.empty() ? "it said nothing" : child.last_line;
    throw Error(child.exit_code > 128
                    ? program + " was ended by signal " + std::to_string(child.exit_code - 128)
                    : said);
}

/** One sequence on its way through the programs. */
class Run {
  public:
    Run(const FoundSequence& sequence, const SequenceRunOptions& options, fs::path folder)
        : sequence_(sequence),
          options_(options),
          folder_(std::move(folder)),
          imported_(folder_ / "sequence.rawlog") {}

    ~Run() {
        std::error_code ignored;
        if (!options_.keep_rawlog) fs::remove(imported_, ignored);
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    void run(SequenceResult& result) {
        const std::string rawlog = import(result);
        slam(rawlog, result);
        evaluate(rawlog, result);
        if (options_.maps) render();
    }

  private:
    std::string log(const std::string& program) const { return folder_ / (program + ".log"); }

    std::string import(SequenceResult& result) const {
        if (fs::path(sequence_.source).extension() == ".rawlog") return sequence_.source;
        const ChildResult child = runChild(
            {siblingProgram("rgbd-import"), sequence_.source, imported_}, log("rgbd-import"));
        require(child, "rgbd-import");
        result.import_s = child.wall_s;
        return imported_;
    }

    void slam(const std::string& rawlog, SequenceResult& result) const {
        std::vector<std::string> command = {siblingProgram("rgbd-slam"),
                                            iniFor(sequence_, options_), rawlog, "-o",
                                            folder_ / "run"};
        for (const auto& assignment : options_.assignments) {
            command.insert(command.end(), {"--set", assignment});
        }
        if (!options_.maps) command.push_back("--no-maps");
        const ChildResult child = runChild(command, log("rgbd-slam"));
        require(child, "rgbd-slam");
        result.slam_s = child.wall_s;
        result.peak_memory_mb = child.peak_memory_mb;
        takeSummary(result);
    }

    void takeSummary(SequenceResult& result) const {
        const std::string path = folder_ / "run/summary.json";
        try {
            std::ifstream in(path);
            const auto summary = nlohmann::json::parse(in);
            summary.at("version").get_to(result.version);
            summary.at("frames").get_to(result.frames);
            summary.at("lost").get_to(result.lost);
            summary.at("keyframes").get_to(result.keyframes);
            summary.at("loops").get_to(result.loops);
            summary.at("cpu_ms_a_frame").get_to(result.cpu_ms_a_frame);
            summary.at("frames_per_s").get_to(result.frames_per_s);
        } catch (const nlohmann::json::exception&) {
            throw Error("'" + path + "' is not what rgbd-slam writes");
        }
    }

    void evaluate(const std::string& rawlog, SequenceResult& result) const {
        const Trajectory truth = truthOf(rawlog);
        if (truth.empty()) return;
        const Trajectory estimate = readTumTrajectory(folder_ / "run/trajectory.txt");
        const AteResult ate = evaluateAte(estimate, truth);
        result.ate_rmse_m = ate.translation_m.rmse;
        result.matched_poses = ate.pairs.size();
        plotTrajectories(truth, {{sequence_.name, estimate, ate}}, PlotPlane::XY,
                         folder_ / "ate.png");
        evaluateDrift(estimate, truth, result);
    }

    /** A clip shorter than a second has no pairs a second apart, and no such error then. */
    static void evaluateDrift(const Trajectory& estimate, const Trajectory& truth,
                              SequenceResult& result) {
        RpeOptions options;
        options.fixed_delta = true;
        if (estimate.back().stamp_s - estimate.front().stamp_s < options.delta) return;
        const RpeResult rpe = evaluateRpe(estimate, truth, options);
        result.rpe_rmse_m = rpe.translation_m.rmse;
        result.rpe_rmse_deg = rpe.rotation_deg.rmse;
    }

    /** A map without picture is still a result. */
    void render() const {
        const ChildResult child =
            runChild({siblingProgram("rgbd-viewer"), folder_ / "run", "--snapshot",
                      folder_ / "view.png", "--width", "640", "--height", "480"},
                     log("rgbd-viewer"));
        if (!child.good()) sayWarning("no picture of " + sequence_.name + ": " + child.last_line);
    }

    const FoundSequence& sequence_;
    const SequenceRunOptions& options_;
    fs::path folder_, imported_;
};

}  // namespace

std::string fingerprintOf(const FoundSequence& sequence, const SequenceRunOptions& options) {
    Hash hash;
    hash.addState(sequence.source);
    if (fs::is_directory(sequence.source)) {
        for (const char* list : {"rgb.txt", "depth.txt", "groundtruth.txt", "camera.ini"}) {
            const fs::path path = fs::path(sequence.source) / list;
            if (fs::exists(path)) hash.addContent(path);
        }
    }
    hash.addContent(iniFor(sequence, options));
    for (const auto& assignment : options.assignments) hash.add(assignment);
    hash.add(options.maps ? "maps" : "no maps");
    for (const char* program : {"rgbd-import", "rgbd-slam"}) hash.addState(siblingProgram(program));
    return hash.text();
}

SequenceResult runSequence(const FoundSequence& sequence, const SequenceRunOptions& options,
                           const std::string& folder) {
    makeWritableFolder(folder);
    SequenceResult result;
    result.name = sequence.name;
    result.fingerprint = fingerprintOf(sequence, options);
    try {
        Run(sequence, options, folder).run(result);
    } catch (const Error& e) {
        result.problem = e.what();
    }
    writeTextAtomically(fs::path(folder) / "result.json", toJson(result));
    return result;
}

}  // namespace rgbd_graphslam
