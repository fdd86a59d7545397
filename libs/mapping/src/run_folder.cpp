#include "rgbd_graphslam/mapping/run_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

nlohmann::json readSummary(const fs::path& path) {
    std::ifstream in(path);
    if (!in) return nlohmann::json::object();
    auto summary = nlohmann::json::parse(in, nullptr, false);
    if (!summary.is_object()) {
        throw Error("'" + path.string() + "' is no JSON object", "run rgbd-slam again");
    }
    return summary;
}

/** Paths are as they were given to rgbd-slam, from whichever folder that ran in. */
std::string findRawlog(const nlohmann::json& summary, const fs::path& folder) {
    const auto found = summary.find("rawlog");
    if (found == summary.end() || !found->is_string()) {
        throw Error("'" + (folder / "summary.json").string() + "' does not name the rawlog",
                    "give --rawlog FILE");
    }
    const fs::path path = found->get<std::string>();
    for (const fs::path& candidate : {path, folder / path, folder / path.filename()}) {
        if (fs::is_regular_file(candidate)) return candidate.string();
    }
    throw Error("the rawlog '" + path.string() + "' of this run is gone", "give --rawlog FILE");
}

/** As it was given to rgbd-slam; nothing when the run was not localized. */
std::optional<std::string> mapFolderOf(const nlohmann::json& summary) {
    const auto map = summary.value("map", nlohmann::json());
    const auto use = map.is_object() ? map.value("use", nlohmann::json()) : nlohmann::json();
    if (use != "localize" && use != "localise") return std::nullopt;  // the latter: first edition
    const auto folder = map.value("folder", nlohmann::json());
    return folder.is_string() ? folder.get<std::string>() : std::string();
}

std::vector<MapLoopEdge> loopsOf(const nlohmann::json& summary) {
    std::vector<MapLoopEdge> loops;
    for (const auto& edge : summary.value("loop_edges", nlohmann::json::array())) {
        loops.push_back({edge.at(0).get<int>(), edge.at(1).get<int>(), edge.at(2).get<int>()});
    }
    return loops;
}

/** Label of the camera; empty = that of the first frame. */
std::string sensorOf(const nlohmann::json& session) {
    const auto label = session.value("sensor", nlohmann::json());
    return label.is_string() ? label.get<std::string>() : std::string();
}

std::vector<EarlierSession> earlierSessionsOf(const nlohmann::json& summary) {
    std::vector<EarlierSession> sessions;
    for (const auto& session : summary.value("earlier_sessions", nlohmann::json::array())) {
        sessions.push_back({session.at("rawlog").get<std::string>(),
                            session.at("keyframes").get<std::size_t>(), sensorOf(session)});
    }
    return sessions;
}

/** Stamps of frames.csv that the trajectory does not have; of a run without that file none. */
std::vector<double> unplacedFrames(const fs::path& frames_csv, const Trajectory& trajectory) {
    constexpr double same_s = 1e-6;  // both files round to it
    std::ifstream in(frames_csv);
    std::vector<double> stamps_s;
    auto pose = trajectory.begin();
    std::string line;
    std::getline(in, line);
    for (int number = 2; std::getline(in, line); ++number) {
        double stamp_s = 0;
        if (!(std::istringstream(line) >> stamp_s)) {
            throw Error(
                frames_csv.string() + ":" + std::to_string(number) + " does not begin with a stamp",
                "run rgbd-slam again");
        }
        while (pose != trajectory.end() && pose->stamp_s < stamp_s - same_s) ++pose;
        const bool placed = pose != trajectory.end() && pose->stamp_s <= stamp_s + same_s;
        if (!placed) stamps_s.push_back(stamp_s);
    }
    return stamps_s;
}

/** \param sessions the earlier ones and the run's own */
void takeEntries(std::vector<FrameEntries> sessions, MapInputs& inputs) {
    if (sessions.size() != inputs.earlier.size() + 1) return;
    for (std::size_t i = 0; i < inputs.earlier.size(); ++i)
        inputs.earlier[i].entries = std::move(sessions[i]);
    inputs.entries = std::move(sessions.back());
}

}  // namespace

bool tellOfGuessedUp(const std::vector<std::string>& warnings) {
    constexpr const char* earlier_words = "as if it had been level";  // of older versions
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& text) {
        return text.find(guessed_up) != std::string::npos ||
               text.find(earlier_words) != std::string::npos;
    });
}

bool upIsGuessed(const std::string& folder) {
    std::vector<std::string> texts;
    const auto warnings =
        readSummary(fs::path(folder) / "summary.json").value("warnings", nlohmann::json::array());
    for (const auto& warning : warnings) {
        if (warning.is_string()) texts.push_back(warning.get<std::string>());
    }
    return tellOfGuessedUp(texts);
}

MapInputs readRunFolder(const std::string& folder, const std::string& rawlog) {
    const fs::path root(folder);
    if (!fs::is_directory(root))
        throw Error("'" + folder + "' is no folder", "give the output folder of rgbd-slam");
    if (const auto map_folder = mapFolderOf(readSummary(root / "summary.json"))) {
        throw Error("the run in '" + folder + "' was localized and has no map of its own",
                    "give the folder of the map, '" + *map_folder + "'");
    }
    if (!fs::exists(root / "keyframes.txt") || !fs::exists(root / "trajectory.txt")) {
        throw Error("'" + folder +
                        "' is no output folder of rgbd-slam: it has no keyframes.txt or no "
                        "trajectory.txt",
                    "give the folder that rgbd-slam wrote with -o");
    }
    const auto summary = readSummary(root / "summary.json");
    MapInputs inputs;
    inputs.keyframes = readTumPoses((root / "keyframes.txt").string());
    inputs.trajectory = readTumTrajectory((root / "trajectory.txt").string());
    inputs.unplaced_s = unplacedFrames(root / "frames.csv", inputs.trajectory);
    inputs.rawlog = rawlog.empty() ? findRawlog(summary, root) : rawlog;
    try {
        inputs.loops = loopsOf(summary);
        inputs.earlier = earlierSessionsOf(summary);
        inputs.sensor_label = sensorOf(summary);
        inputs.up_is_guessed = upIsGuessed(folder);
        const bool is_old = summary.contains("apart_keyframes");  // as the first edition wrote it
        inputs.disconnected = summary.value(is_old ? "apart_keyframes" : "disconnected_keyframes",
                                            std::vector<int>());
    } catch (const nlohmann::json::exception&) {
        throw Error("'loop_edges', 'earlier_sessions' or 'disconnected_keyframes' in '" +
                        (root / "summary.json").string() + "' is not what rgbd-slam writes",
                    "run rgbd-slam again");
    }
    if (rawlog.empty()) takeEntries(readFrameEntries((root / frame_entries_name).string()), inputs);
    const fs::path before = root / "keyframes_before_loops.txt";
    if (fs::exists(before)) inputs.keyframes_before_loops = readTumPoses(before.string());
    return inputs;
}

std::optional<LocalizedRun> readLocalizedRun(const std::string& folder) {
    const fs::path root(folder);
    const auto map_folder = mapFolderOf(readSummary(root / "summary.json"));
    if (!map_folder) return std::nullopt;
    LocalizedRun run;
    for (const fs::path& candidate : {fs::path(*map_folder), root / *map_folder}) {
        const bool has_map = fs::exists(candidate / "keyframes.txt");
        if (run.map_folder.empty() && has_map) run.map_folder = candidate.string();
    }
    if (run.map_folder.empty()) {
        throw Error("the map '" + *map_folder + "' that this run was localized in is gone",
                    "run rgbd-slam again");
    }
    run.trajectory = readTumTrajectory((root / "trajectory.txt").string());
    run.unplaced_s = unplacedFrames(root / "frames.csv", run.trajectory);
    return run;
}

MapOptions readRunOptions(const std::string& folder) {
    MapOptions options;
    const fs::path path = fs::path(folder) / "config.ini";
    if (fs::exists(path)) IniFile::fromFile(path.string()).loadKnown({&options});
    return options;
}

}  // namespace rgbd_graphslam
