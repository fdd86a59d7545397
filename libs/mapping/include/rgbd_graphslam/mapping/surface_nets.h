/** The surface of a distance field as triangles. */
#pragma once
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/mapping/tsdf_volume.h"

namespace rgbd_graphslam {

/** Colored triangles where the distance is zero, wound counter-clockwise as seen from the free
 *  side. Surface nets (Gibson, "Constrained elastic surface nets", MICCAI 1998): each cell between
 *  eight voxels that the surface passes gets a vertex in the middle of where it crosses the cell's
 *  edges, each crossed edge joins the four cells around it. A cell that several sheets of surface
 *  pass gets a vertex for each, as in dual marching cubes (Nielson, Visualization 2004), so that
 *  sheets close to each other are not glued together. The mesh ends where voxels were not seen.
 *  \param blocks of a TsdfVolume
 *  \param voxel_m edge of its voxels */
PlyModel surfaceOf(const TsdfVolume::BlockTable& blocks, double voxel_m);

}  // namespace rgbd_graphslam
