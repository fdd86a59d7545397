#include "rgbd_graphslam/evaluation/stamped_list.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

std::vector<std::string> wordsOf(std::string line) {
    line.resize(std::min(line.size(), line.find('#')));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<std::string> found;
    for (std::string word; words >> word;) found.push_back(word);
    return found;
}

double stampOf(const std::string& word, const std::string& path, int line) {
    char* end = nullptr;
    const double stamp_s = std::strtod(word.c_str(), &end);
    if (*end || !std::isfinite(stamp_s)) {
        throw Error(path + ":" + std::to_string(line) + ": '" + word + "' is no stamp in seconds",
                    "each line must begin with one");
    }
    return stamp_s;
}

std::string textOf(const StampedLine& line) {
    char stamp[32];
    std::snprintf(stamp, sizeof(stamp), "%.6f", line.stamp_s);
    return line.rest.empty() ? stamp : stamp + (" " + line.rest);
}

}  // namespace

std::vector<StampedLine> readStampedList(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw Error("cannot read the list '" + path + "'", "check the name");
    std::map<double, std::string> rest_at;
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        const auto words = wordsOf(text);
        if (words.empty()) continue;
        std::string rest;
        for (std::size_t k = 1; k < words.size(); ++k) rest += (k > 1 ? " " : "") + words[k];
        rest_at[stampOf(words.front(), path, line)] = rest;
    }
    if (rest_at.empty()) throw Error("no stamp in '" + path + "'", "give a list of the TUM format");
    std::vector<StampedLine> lines;
    lines.reserve(rest_at.size());
    for (const auto& [stamp_s, rest] : rest_at) lines.push_back({stamp_s, rest});
    return lines;
}

std::vector<double> stampsOf(const std::vector<StampedLine>& lines) {
    std::vector<double> stamps_s;
    stamps_s.reserve(lines.size());
    for (const auto& line : lines) stamps_s.push_back(line.stamp_s);
    return stamps_s;
}

std::string associationText(const std::vector<StampedLine>& first,
                            const std::vector<StampedLine>& second,
                            const AssociationOptions& options) {
    const auto pairs =
        associate(stampsOf(first), stampsOf(second), options.max_difference_s, options.offset_s);
    if (pairs.empty()) {
        throw Error("no stamps of the two lists are within " +
                        secondsText(options.max_difference_s) + " of each other",
                    "give --offset or a larger --max-difference");
    }
    std::string text;
    for (const auto& [i, j] : pairs) {
        text += textOf(first[i]) + (options.first_only ? "" : " " + textOf(second[j])) + "\n";
    }
    return text;
}

}  // namespace rgbd_graphslam
