#include "rgbd_graphslam/benchmark/benchmark_report.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/report/html.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> columns = {
    "sequence",       "frames",           "lost",    "keyframes", "loops",
    "ATE RMSE m",     "best published m", "matched", "RPE 1 s m", "RPE 1 s °",
    "CPU ms a frame", "frames/s",         "peak MB", "import s",  "SLAM and maps s"};

const char* const explanation =
    "ATE: of all poses after alignment without scale, as the TUM benchmark's tools compute it. "
    "Best published: the lowest RMSE found in papers for an RGB-D camera on the whole sequence. "
    "Matched: poses for which there is truth. RPE: over one second. CPU: all threads, tracking "
    "with reading, without maps. Peak: largest resident set of rgbd-slam.";

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string orDash(const std::optional<double>& value, int decimals) {
    return value ? fixed(*value, decimals) : "–";
}

/** The sequence that a result is of, wherever its folder lay: "freiburg1_rgbd_dataset_..." too. */
const KnownSequence* knownAs(const std::string& name, const std::vector<KnownSequence>& table) {
    const auto at = name.rfind("rgbd_dataset_");
    return findSequence(table, at == std::string::npos ? name : name.substr(at));
}

std::vector<std::string> cellsOf(const SequenceResult& result,
                                 const std::vector<KnownSequence>& table) {
    const KnownSequence* known = knownAs(result.name, table);
    const std::string best = orDash(known ? known->best_ate_m : std::nullopt, 4);
    std::vector<std::string> cells = {result.name};
    if (!result.problem.empty()) {
        cells.resize(columns.size(), "–");
        cells[5] = "failed";
        cells[6] = best;
        return cells;
    }
    for (const std::size_t count : {result.frames, result.lost, result.keyframes, result.loops}) {
        cells.push_back(std::to_string(count));
    }
    cells.insert(cells.end(),
                 {orDash(result.ate_rmse_m, 4), best, std::to_string(result.matched_poses),
                  orDash(result.rpe_rmse_m, 4), orDash(result.rpe_rmse_deg, 3),
                  fixed(result.cpu_ms_a_frame, 1), fixed(result.frames_per_s, 1),
                  fixed(result.peak_memory_mb, 0),
                  result.import_s > 0 ? fixed(result.import_s, 1) : "–", fixed(result.slam_s, 1)});
    return cells;
}

std::string summaryOf(const std::vector<SequenceResult>& results,
                      const std::vector<KnownSequence>& table) {
    std::size_t failed = 0, compared = 0, as_good = 0;
    std::string version;
    for (const auto& result : results) {
        if (!result.problem.empty()) ++failed;
        if (!result.version.empty()) version = result.version;
        const KnownSequence* known = knownAs(result.name, table);
        if (!known || !known->best_ate_m || !result.ate_rmse_m) continue;
        ++compared;
        if (*result.ate_rmse_m <= *known->best_ate_m) ++as_good;
    }
    std::string text =
        std::to_string(results.size()) + (results.size() == 1 ? " sequence" : " sequences");
    if (!version.empty()) text += " with rgbd-graphslam " + version;
    if (failed > 0) text += ", " + std::to_string(failed) + " failed";
    if (compared > 0) {
        text += "; " + std::to_string(as_good) + " of " + std::to_string(compared) +
                " at least as good as the best published";
    }
    return text + ".";
}

/** What rgbd-slam itself reports, relative to the benchmark's folder. */
std::string runPage(const SequenceResult& result) {
    return result.name + "/run/report.html";
}

std::string markdownRow(const std::vector<std::string>& cells) {
    std::string row = "|";
    for (const auto& cell : cells) row += " " + cell + " |";
    return row + "\n";
}

std::string markdown(const std::vector<SequenceResult>& results,
                     const std::vector<KnownSequence>& table, const fs::path& folder) {
    std::string text = "# RGB-D benchmark\n\n" + summaryOf(results, table) + "\n\n";
    text += markdownRow(columns) + markdownRow(std::vector<std::string>(columns.size(), "---"));
    for (const auto& result : results) text += markdownRow(cellsOf(result, table));
    text += "\n" + std::string(explanation) + "\n";
    for (const auto& result : results) {
        text += "\n## " + result.name + "\n\n";
        if (!result.problem.empty()) text += "Failed: " + result.problem + "\n";
        if (fs::exists(folder / runPage(result))) {
            text += "[The run in detail](" + runPage(result) + ")\n\n";
        }
        for (const char* picture : {"ate.png", "view.png"}) {
            const std::string path = result.name + "/" + picture;
            if (fs::exists(folder / path)) text += "![" + path + "](" + path + ")\n";
        }
    }
    return text;
}

std::string embedded(const fs::path& picture, const std::string& description) {
    std::ifstream in(picture, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    return embeddedImage("image/png", bytes, description);
}

std::string htmlRow(const std::vector<std::string>& cells, const std::string& tag) {
    std::string row = "<tr>";
    for (const auto& cell : cells) row += "<" + tag + ">" + htmlEscaped(cell) + "</" + tag + ">";
    return row + "</tr>\n";
}

std::string html(const std::vector<SequenceResult>& results,
                 const std::vector<KnownSequence>& table, const fs::path& folder) {
    std::string text =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<title>RGB-D benchmark</title><style>\n"
        "body { font-family: sans-serif; margin: 2em; }\n"
        "table { border-collapse: collapse; } td, th { padding: 0.2em 0.7em; "
        "border-bottom: 1px solid #ccc; text-align: right; }\n"
        "td:first-child, th:first-child { text-align: left; white-space: nowrap; } img { "
        "max-width: 48%; }\n"
        "</style></head><body>\n<h1>RGB-D benchmark</h1>\n<p>" +
        htmlEscaped(summaryOf(results, table)) + "</p>\n<table>\n" + htmlRow(columns, "th");
    for (const auto& result : results) text += htmlRow(cellsOf(result, table), "td");
    text += "</table>\n<p>" + std::string(explanation) + "</p>\n";
    for (const auto& result : results) {
        text += "<h2>" + htmlEscaped(result.name) + "</h2>\n";
        if (!result.problem.empty()) text += "<p>Failed: " + htmlEscaped(result.problem) + "</p>\n";
        if (fs::exists(folder / runPage(result))) {
            text +=
                "<p><a href=\"" + htmlEscaped(runPage(result)) + "\">The run in detail</a></p>\n";
        }
        text += embedded(folder / result.name / "ate.png", "path and truth of " + result.name);
        text += embedded(folder / result.name / "view.png", "map of " + result.name);
    }
    return text + "</body></html>\n";
}

std::vector<SequenceResult> resultsIn(const fs::path& folder) {
    std::vector<SequenceResult> results;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (const auto result = readResult(entry.path())) results.push_back(*result);
    }
    std::sort(results.begin(), results.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return results;
}

}  // namespace

std::vector<SequenceResult> writeReport(const std::string& folder,
                                        const std::vector<KnownSequence>& table) {
    auto results = resultsIn(folder);
    if (results.empty()) throw Error("'" + folder + "' holds no result", "run the benchmark first");
    writeTextAtomically(fs::path(folder) / "report.md", markdown(results, table, folder));
    writeTextAtomically(fs::path(folder) / "report.html", html(results, table, folder));
    return results;
}

}  // namespace rgbd_graphslam
