/** An output folder of rgbd-slam, as small as it can be. */
#pragma once
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "../../support/tum_folder.h"

namespace rgbd_graphslam {

/** What a test wants a run to be. */
struct MadeRun {
    std::string rawlog = "/data/a.rawlog";
    int frames = 60;
    int first_lost = 0, end_lost = 0;  // frames [first_lost, end_lost)
    double depth_factor = 1;           // of the estimate's positions against the truth
    bool with_truth = true, with_maps = true, with_loop = true;
    // JSON
    std::string warnings = "[]", loop_edges = "[[0, 5, 40, 0.01]]", false_loops = "0",
                earlier_sessions = "[]", origin = "{}", quality = "{}";
};

constexpr double made_start_s = 1000;

inline std::string poseLine(int frame, double factor) {
    char text[128];
    const double angle = 0.1 * frame;
    std::snprintf(text, sizeof(text), "%.6f %.6f %.6f 1.2 0 0 0 1\n", made_start_s + 0.1 * frame,
                  factor * 2 * std::cos(angle), factor * 2 * std::sin(angle));
    return text;
}

inline std::string summaryText(const MadeRun& run) {
    const char* figures = R"({"mean": 3, "median": 2.5, "p95": 4, "max": 9})";
    return "{\"version\": \"0.1.0\", \"config_hash\": \"0123456789abcdef\", \"rawlog\": \"" +
           run.rawlog + "\", \"earlier_sessions\": " + run.earlier_sessions +
           ", \"origin\": " + run.origin +
           ", \"interrupted\": false, \"damage\": null, \"warnings\": " + run.warnings +
           ", \"out_of_order\": 0, \"culled_keyframes\": 0, \"landmarks\": 700, " +
           "\"loop_edges\": " + (run.with_loop ? run.loop_edges : "[]") +
           ", \"quality\": " + run.quality + ", \"false_loops\": " + run.false_loops +
           ", \"ate\": {\"rmse_m\": 0.0123}" +
           ", \"path_m\": 12, \"frames_per_s\": 90, \"cpu_ms_a_frame\": 7, \"maps_wall_s\": 2, " +
           "\"peak_memory_mb\": 200, \"stages\": {\"track\": {\"calls\": 60, \"cpu_ms\": " +
           figures + ", \"wall_ms\": " + figures + "}}}";
}

/** Writes the files; map.png is of one color, magenta. */
inline void makeRunFolder(const TestFolder& folder, const MadeRun& run) {
    std::string trajectory, truth, keyframes, frames = "stamp_s,origin,inliers,keyframe\n";
    for (int i = 0; i < run.frames; ++i) {
        const bool lost = i >= run.first_lost && i < run.end_lost, keyframe = i % 10 == 0;
        if (!lost) trajectory += poseLine(i, run.depth_factor);
        if (keyframe) keyframes += poseLine(i, run.depth_factor);
        truth += poseLine(i, 1);
        char line[64];
        std::snprintf(line, sizeof(line), "%.6f,%s,%d,", made_start_s + 0.1 * i,
                      lost ? "lost" : "tracked", lost ? 0 : 300);
        frames += line + (keyframe ? std::to_string(i / 10) : std::string()) + "\n";
    }
    folder.write("trajectory.txt", trajectory);
    folder.write("keyframes.txt", keyframes);
    folder.write("frames.csv", frames);
    folder.write("summary.json", summaryText(run));
    if (run.with_truth) folder.write("truth.txt", truth);
    if (run.with_loop) folder.write("keyframes_before_loops.txt", keyframes);
    if (run.with_maps) {
        cv::imwrite(folder / "map.png", cv::Mat(300, 400, CV_8UC3, cv::Scalar(255, 0, 255)));
    }
}

}  // namespace rgbd_graphslam
