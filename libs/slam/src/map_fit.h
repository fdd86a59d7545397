/** Whether a run can start from a map. */
#pragma once
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** \param features settings of the run
 *  \param camera of the run
 *  \throws Error when the map is of another image pyramid, or is to be extended by another camera
 */
void requireFits(const MapSnapshot& map, const FeatureOptions& features, const Camera& camera,
                 MapUse use);

/** Moves the keypoints to where a camera would have seen them from the same places. */
void seeWith(const Camera& camera, MapSnapshot& map);

}  // namespace rgbd_graphslam
