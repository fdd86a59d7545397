/** Where the frames of a run are in its rawlog. */
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A frame and its entry in the rawlog: the observations that RawlogReader hands out, counted
 *  from 0. */
struct FrameEntry {
    double stamp_s = 0;
    std::size_t entry = 0;
};

/** Of one session, by rising stamp and entry. */
using FrameEntries = std::vector<FrameEntry>;

/** Of the file in a run's output folder. */
inline constexpr const char* frame_entries_name = "frame_entries.csv";

/** The entry of the frame with this stamp, which files round to microseconds. */
std::optional<std::size_t> entryAt(const FrameEntries& frames, double stamp_s);

/** One line per frame: session, counted from 0, stamp, and entry. */
std::string frameEntriesCsv(const std::vector<FrameEntries>& sessions);

/** \return one list per session; nothing where there is no such file, as with runs of earlier
 *          versions
 *  \throws Error naming file and line of what is not as frameEntriesCsv() writes it */
std::vector<FrameEntries> readFrameEntries(const std::string& path);

}  // namespace rgbd_graphslam
