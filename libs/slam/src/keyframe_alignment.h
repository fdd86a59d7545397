/** Pose of a frame by one keyframe alone. */
#pragma once
#include <optional>

#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Matches a frame with the landmarks of a keyframe, aligns the points of both by RANSAC and
 * refines the pose. Needs no idea of where the frame is. \return the landmarks that agree; nothing
 * when too few do */
std::optional<LocatedFrame> alignWithKeyframe(const Frame& frame, const Keyframe& keyframe,
                                              const SlamMap& map, const RigCameras& cameras,
                                              const SlamOptions& options);

}  // namespace rgbd_graphslam
