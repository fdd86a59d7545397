#include "rgbd_graphslam/benchmark/sequence_result.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace nlohmann {

/** Nothing is null. */
template <>
struct adl_serializer<std::optional<double>> {
    static void to_json(json& json, const std::optional<double>& value) {
        if (value) {
            json = *value;
        } else {
            json = nullptr;
        }
    }
    static void from_json(const json& json, std::optional<double>& value) {
        value.reset();
        if (!json.is_null()) value = json.get<double>();
    }
};

}  // namespace nlohmann

namespace rgbd_graphslam {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SequenceResult, name, fingerprint, problem, version, frames,
                                   lost, keyframes, loops, ate_rmse_m, rpe_rmse_m, rpe_rmse_deg,
                                   matched_poses, cpu_ms_a_frame, frames_per_s, peak_memory_mb,
                                   import_s, slam_s)

std::string toJson(const SequenceResult& result) {
    const auto replace = nlohmann::json::error_handler_t::replace;  // names may be no UTF-8
    return nlohmann::json(result).dump(2, ' ', false, replace) + "\n";
}

SequenceResult resultFromJson(const std::string& text, const std::string& path) {
    try {
        return nlohmann::json::parse(text).get<SequenceResult>();
    } catch (const nlohmann::json::exception&) {
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
