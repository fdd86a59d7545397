/** Depth images as a robot with a level laser scanner would see what they show. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/depth_view.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** The pose on the floor below an upright camera that looks where it looks: x, y and yaw only.
 *  2-D maps and particle filters of MRPT need their robot there. */
SE3 basePose(const SE3& T_up_cam);

/** The nearest surface between z_min_m and z_max_m in each direction; directions without one are
 *  marked invalid. The caller gives it a stamp.
 *  \param T_base_cam base as by basePose(); the scan is relative to it */
mrpt::obs::CObservation2DRangeScan::Ptr levelScan(const DepthView& view, const SE3& T_base_cam,
                                                  const MapOptions& options);

}  // namespace rgbd_graphslam
