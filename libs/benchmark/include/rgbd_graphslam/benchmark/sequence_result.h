/** What a benchmark found about one sequence. */
#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Figures of one sequence, or why there are none. */
struct SequenceResult {
    std::string name;
    /** Of recording, settings and programs: a result with another one is out of date. */
    std::string fingerprint;
    /** Why there are no figures; empty when all went well. */
    std::string problem;
    std::string version;  // of rgbd-slam
    std::size_t frames = 0, lost = 0, keyframes = 0, loops = 0;
    /** Against the truth; nothing without truth. */
    std::optional<double> ate_rmse_m, rpe_rmse_m, rpe_rmse_deg;
    std::size_t matched_poses = 0;
    double cpu_ms_a_frame = 0, frames_per_s = 0, peak_memory_mb = 0;
    /** Of import (0 for a rawlog) and of SLAM with its maps, by the clock. */
    double import_s = 0, slam_s = 0;
};

/** Result as JSON text, and back.
 *  \throws Error naming `path` when the text is none */
std::string toJson(const SequenceResult& result);
SequenceResult resultFromJson(const std::string& text, const std::string& path);

/** The result in a sequence's folder of a benchmark; nothing when there is none. */
std::optional<SequenceResult> readResult(const std::string& folder);

}  // namespace rgbd_graphslam
