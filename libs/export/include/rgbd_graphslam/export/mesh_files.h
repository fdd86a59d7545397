/** Meshes as glTF and Wavefront OBJ. */
#pragma once
#include <string>

#include "rgbd_graphslam/export/textured_mesh.h"
#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** Binary glTF 2.0 in one file, y up as glTF wants it (z of the mesh), unlit, since light and shade
 *  are in the colors already (KHR_materials_unlit). \throws Error when it cannot be written */
void writeGlb(const std::string& path, const TexturedMesh& mesh);
/** With the colors of its vertices. */
void writeGlb(const std::string& path, const PlyModel& mesh);

/** mesh.obj, mesh.mtl and mesh.jpg in a folder, z up as the mesh. */
void writeObj(const std::string& folder, const TexturedMesh& mesh);
/** mesh.obj with the colors of its vertices behind their coordinates, as MeshLab and others read
 *  it. */
void writeObj(const std::string& folder, const PlyModel& mesh);

}  // namespace rgbd_graphslam
