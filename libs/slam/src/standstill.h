/** Whether the camera stands where a keyframe was made. */
#pragma once
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** A camera that moves displaces the whole image, something that walks through the view a part of
 *  it, and noise of depth nothing. So the landmarks' pixels are compared with those of a keyframe,
 *  quarter by quarter of the image: where their medians agree in three quarters to a fraction of a
 *  pixel, the camera has not moved, whatever the other quarter and the depths say. */
bool standsAt(const Keyframe& keyframe, const Frame& frame, const std::vector<int>& landmarks,
              const SlamMap& map, const RigCameras& cameras);

}  // namespace rgbd_graphslam
