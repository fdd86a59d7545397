/** Cleaning of triangle meshes. */
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** The mesh without parts of less area than this, parts being triangles that hang together, and
 *  without vertices that no triangle has. */
PlyModel withoutSmallParts(const PlyModel& mesh, double min_area_m2);

/** The mesh of some of its triangles, with the vertices that they need, in their order; without
 *  normals. */
PlyModel meshOf(const PlyModel& mesh, std::vector<std::array<std::uint32_t, 3>> triangles);

/** Gives each vertex the mean normal of its triangles, weighted by their area. */
void addNormals(PlyModel& mesh);

}  // namespace rgbd_graphslam
