/** Keyframes as MRPT's tools want them. */
#pragma once
#include <mrpt/maps/CSimpleMap.h>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/depth_view.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** Adds a keyframe: its base pose, and two observations from there: the depth image as the
 *  3-D points of a CObservation3DRangeScan, one a leaf of the octree, and as a level laser scan,
 * see levelScan. */
void addKeyframe(mrpt::maps::CSimpleMap& map, double stamp_s, const SE3& T_up_cam,
                 const DepthView& view, const MapOptions& options);

}  // namespace rgbd_graphslam
