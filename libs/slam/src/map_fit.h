/** Whether a run can start from a map. */
#pragma once
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** \param features settings of the run
 *  \param rig of the run
 *  \throws Error when the map is of another image pyramid or another number of cameras, or is to be
 *          extended by other cameras */
void requireFits(const MapSnapshot& map, const FeatureOptions& features, const Rig& rig,
                 MapUse use);

/** Moves the keypoints to where these cameras would have seen them from the same places. */
void seeWith(const Rig& rig, MapSnapshot& map);

}  // namespace rgbd_graphslam
