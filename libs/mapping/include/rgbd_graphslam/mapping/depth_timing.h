/** Depth images that are taken at another moment than the color images they belong to. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Takes up the stamps of depth images if an entry of a rawlog tells them. */
void noteDepthStamps(const mrpt::obs::CObservation& observation, DepthStamps& stamps);

/** Of the depth image that belongs to a color image. */
double depthStamp(const DepthStamps& stamps, double color_stamp_s);

/** Where the camera was when it took the keyframe's depth image: its pose, moved on by what the
 *  trajectory says about the time between the two stamps, up to 16 ms for a Kinect. The pose itself
 *  where the trajectory has no poses close by.
 *  \param trajectory of every frame, in any frame of reference */
SE3 depthPose(const StampedPose& keyframe, double depth_stamp_s, const Trajectory& trajectory);

}  // namespace rgbd_graphslam
