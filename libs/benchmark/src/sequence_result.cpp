#include "rgbd_graphslam/benchmark/sequence_result.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

std::optional<double> optionalNumber(const Json& json) {
    if (json.is_null()) return std::nullopt;
    return json.get<double>();
}

}  // namespace

std::string toJson(const SequenceResult& result) {
    const Json json = {{"name", result.name},
                       {"fingerprint", result.fingerprint},
                       {"problem", result.problem},
                       {"version", result.version},
                       {"frames", result.frames},
                       {"lost", result.lost},
                       {"keyframes", result.keyframes},
                       {"loops", result.loops},
                       {"ate_rmse_m", orNull(result.ate_rmse_m)},
                       {"rpe_rmse_m", orNull(result.rpe_rmse_m)},
                       {"rpe_rmse_deg", orNull(result.rpe_rmse_deg)},
                       {"matched_poses", result.matched_poses},
                       {"cpu_ms_a_frame", result.cpu_ms_a_frame},
                       {"frames_per_s", result.frames_per_s},
                       {"peak_memory_mb", result.peak_memory_mb},
                       {"import_s", result.import_s},
                       {"slam_s", result.slam_s}};
    return json.dump(2) + "\n";
}

SequenceResult resultFromJson(const std::string& text, const std::string& path) {
    try {
        const Json json = Json::parse(text);
        SequenceResult result;
        json.at("name").get_to(result.name);
        json.at("fingerprint").get_to(result.fingerprint);
        json.at("problem").get_to(result.problem);
        json.at("version").get_to(result.version);
        json.at("frames").get_to(result.frames);
        json.at("lost").get_to(result.lost);
        json.at("keyframes").get_to(result.keyframes);
        json.at("loops").get_to(result.loops);
        result.ate_rmse_m = optionalNumber(json.at("ate_rmse_m"));
        result.rpe_rmse_m = optionalNumber(json.at("rpe_rmse_m"));
        result.rpe_rmse_deg = optionalNumber(json.at("rpe_rmse_deg"));
        json.at("matched_poses").get_to(result.matched_poses);
        json.at("cpu_ms_a_frame").get_to(result.cpu_ms_a_frame);
        json.at("frames_per_s").get_to(result.frames_per_s);
        json.at("peak_memory_mb").get_to(result.peak_memory_mb);
        json.at("import_s").get_to(result.import_s);
        json.at("slam_s").get_to(result.slam_s);
        return result;
    } catch (const Json::exception&) {
        throw Error("'" + path + "' is no result of rgbd-benchmark", "remove it");
    }
}

std::optional<SequenceResult> readResult(const std::string& folder) {
    const std::string path = std::filesystem::path(folder) / "result.json";
    std::ifstream in(path);
    if (!in) return std::nullopt;
    std::stringstream text;
    text << in.rdbuf();
    return resultFromJson(text.str(), path);
}

}  // namespace rgbd_graphslam
