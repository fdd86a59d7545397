/** The mesh of a run with its images on it. */
#pragma once
#include "rgbd_graphslam/export/exporter.h"
#include "rgbd_graphslam/export/textured_mesh.h"

namespace rgbd_graphslam {

struct RunTexture {
    TexturedMesh mesh;
    double covered_share = 0;  // of the triangles
};

/** Reads the images of the run twice.
 *  \throws Error when there is no mesh, or images cannot be read */
RunTexture textureOf(const std::string& run_folder, const ExportOptions& options);

/** "81024 triangles, 98 % of them textured, texture of 4096 x 3120 pixels" */
std::string describe(const RunTexture& textured);

}  // namespace rgbd_graphslam
