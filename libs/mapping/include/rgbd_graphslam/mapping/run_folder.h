/** A finished run's output folder as the source of new maps. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/map_builder.h"

namespace rgbd_graphslam {

/** Reads keyframes.txt, trajectory.txt, and from summary.json the rawlog's path ("rawlog") and the
 *  loops ("loop_edges": [[from, to, inliers, ...], ...], optional; what follows is left alone) and
 *  "earlier_sessions" ([{"rawlog", "keyframes", "sensor"}, ...], optional), "sensor" (label of the
 *  camera, optional); keyframes_before_loops.txt when it is there.
 *  \param rawlog takes the place of the one in summary.json unless empty
 *  \throws Error when a file is missing or makes no sense, or the run has no map of its own */
MapInputs readRunFolder(const std::string& folder, const std::string& rawlog);

/** A run that was localized in the map of another. */
struct LocalizedRun {
    std::string map_folder;
    Trajectory trajectory;
    /** Stamps of frames without a pose, rising. */
    std::vector<double> unplaced_s;
};

/** \return nothing when the folder is not that of such a run
 *  \throws Error when a file makes no sense, or the folder of the map is gone */
std::optional<LocalizedRun> readLocalizedRun(const std::string& folder);

/** Whether a run's warnings tell that its z axis is a guess. */
bool tellOfGuessedUp(const std::vector<std::string>& warnings);
/** The same, of the warnings in a run's output folder. */
bool upIsGuessed(const std::string& folder);

/** Section MapOptions of the folder's config.ini; defaults when there is no such file. Other
 * sections are left alone. \throws Error as IniFile does */
MapOptions readRunOptions(const std::string& folder);

}  // namespace rgbd_graphslam
