/** Cleaning of triangle meshes. */
#pragma once
#include "rgbd_graphslam/evaluation/ply.h"

namespace rgbd_graphslam {

/** The mesh without parts of less area than this, parts being triangles that hang together, and
 *  without vertices that no triangle has. */
PlyModel withoutSmallParts(const PlyModel& mesh, double min_area_m2);

/** Gives each vertex the mean normal of its triangles, weighted by their area. */
void addNormals(PlyModel& mesh);

}  // namespace rgbd_graphslam
