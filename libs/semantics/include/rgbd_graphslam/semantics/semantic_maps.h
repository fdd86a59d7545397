/** Files of labeled maps. */
#pragma once
#include <string>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/map_options.h"
#include "rgbd_graphslam/semantics/semantic_options.h"

namespace rgbd_graphslam {

/** What was written. */
struct SemanticSummary {
    std::size_t labeled_frames = 0, voxels = 0, objects = 0;
};

/** Whether the recording of a finished run has label images, by its summary.json. */
bool hasLabels(const std::string& run_folder);

/** Removes what writeSemanticMaps() wrote into a folder: beside maps of another run it would pass for
 *  theirs. */
void removeSemanticMaps(const std::string& folder);

/** Writes labels.ply (points with class, confidence and number of views), labels.png (the map from
 *  above, colored by class) and objects.json, if the rawlog has label images.
 *  \param inputs upright
 *  \return nothing labeled when there are none: then nothing is written, and older files of these
 *          names are removed, which were of other poses
 *  \throws Error when something cannot be read or written */
SemanticSummary writeSemanticMaps(const MapInputs& inputs, const MapOptions& maps,
                                  const SemanticOptions& options, const std::string& out_folder);

}  // namespace rgbd_graphslam
