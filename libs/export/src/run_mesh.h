/** The mesh of a run. */
#pragma once
#include <string>

#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** mesh.ply of a run: triangles with colors of their vertices.
 *  \throws Error saying how to make it when there is none, or when it is damaged or no mesh */
PlyModel readRunMesh(const std::string& run_folder);

}  // namespace rgbd_graphslam
