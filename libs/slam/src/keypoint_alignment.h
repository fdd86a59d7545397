/** Exact places of keypoints whose landmarks are known. */
#pragma once
#include <vector>

#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

/** Moves keypoints to where the patches of the landmarks that they show lie, and marks those as
 *  aligned. Without patches nothing moves.
 *  \param landmarks one per keypoint, or no_landmark
 *  \param T_cam_world of the first camera, within a few pixels */
void alignKeypoints(Frame& frame, const std::vector<int>& landmarks, const SE3& T_cam_world,
                    const RigCameras& cameras, const SlamMap& map);

}  // namespace rgbd_graphslam
