/** Keypoints as the measurements that solvers take. */
#pragma once
#include "rgbd_graphslam/estimation/reprojection.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** \param octave_scale side of the octave's pixels, in pixels of the image
 *  \param sensor noise of keypoints and of depth */
Measurement measurementOf(const Keypoint& keypoint, double octave_scale,
                          const SensorOptions& sensor);

}  // namespace rgbd_graphslam
