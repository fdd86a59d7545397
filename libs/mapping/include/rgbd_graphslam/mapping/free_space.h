/** Space that a view looks through. */
#pragma once
#include <functional>

#include "rgbd_graphslam/mapping/occupancy_volume.h"

namespace rgbd_graphslam {

/** Calls carve(cube) for the largest aligned cubes, down to single voxels, that lie wholly before
 *  the readings of a view. Descends from large cubes to small ones only near surfaces, so that its
 *  cost follows the surface in sight and not the volume. */
void forEachFreeCube(const SE3& T_world_cam, const DepthView& view, double resolution_m,
                     const std::function<void(const VoxelCube&)>& carve);

}  // namespace rgbd_graphslam
