#include "rgbd_graphslam/mapping/frame_entries.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most_sessions = 10000;

struct Line {
    std::size_t session = 0;
    FrameEntry frame;
};

std::optional<Line> parsed(const std::string& text) {
    Line line;
    int end = 0;
    const int fields = std::sscanf(text.c_str(), "%zu,%lf,%zu%n", &line.session,
                                   &line.frame.stamp_s, &line.frame.entry, &end);
    if (fields != 3 || text[static_cast<std::size_t>(end)] != '\0') return std::nullopt;
    return line;
}

/** \return false where the line is out of order */
bool append(const Line& line, std::vector<FrameEntries>& sessions) {
    const std::size_t last = sessions.empty() ? 0 : sessions.size() - 1;
    // Sessions of earlier versions and live ones have no entries.
    if (line.session < last || line.session > most_sessions) return false;
    sessions.resize(line.session + 1);
    FrameEntries& frames = sessions.back();
    const FrameEntry& frame = line.frame;
    const bool rises = frames.empty() ||
                       (frame.stamp_s > frames.back().stamp_s && frame.entry > frames.back().entry);
    frames.push_back(frame);
    return rises;
}

}  // namespace

std::optional<std::size_t> entryAt(const FrameEntries& frames, double stamp_s) {
    constexpr double tolerance_s = 5e-4;
    const auto near =
        std::lower_bound(frames.begin(), frames.end(), stamp_s - tolerance_s,
                         [](const FrameEntry& frame, double s) { return frame.stamp_s < s; });
    if (near == frames.end() || near->stamp_s > stamp_s + tolerance_s) return std::nullopt;
    return near->entry;
}

std::string frameEntriesCsv(const std::vector<FrameEntries>& sessions) {
    std::string text = "session,stamp_s,entry\n";
    for (std::size_t session = 0; session < sessions.size(); ++session) {
        for (const FrameEntry& frame : sessions[session])
            text += formatted("%zu,%.6f,%zu\n", session, frame.stamp_s, frame.entry);
    }
    return text;
}

std::vector<FrameEntries> readFrameEntries(const std::string& path) {
    std::vector<FrameEntries> sessions;
    std::ifstream in(path);
    std::string text;
    std::getline(in, text);
    for (int number = 2; std::getline(in, text); ++number) {
        const auto line = parsed(text);
        if (line && append(*line, sessions)) continue;
        throw Error(path + ":" + std::to_string(number) +
                        " is not 'session,stamp_s,entry' in "
                        "rising order",
                    "run rgbd-slam again");
    }
    return sessions;
}

}  // namespace rgbd_graphslam
