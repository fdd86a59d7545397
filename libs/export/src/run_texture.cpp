#include "run_texture.h"

#include <cmath>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "run_images.h"
#include "run_mesh.h"

namespace rgbd_graphslam {

RunTexture textureOf(const std::string& run_folder, const ExportOptions& options) {
    const PlyModel mesh = readRunMesh(run_folder);
    const MapInputs run = readRunFolder(run_folder, options.rawlog);
    TextureBuilder builder(mesh, options.texture_size);
    forEachImage(run, options.all_frames, "choosing images", [&](const RunImage& image) {
        builder.addView(image.number, image.camera, image.pose.T_world_cam, image.depth,
                        image.depth_unit_m);
    });
    builder.plan();
    forEachImage(run, options.all_frames, "texture", [&](const RunImage& image) {
        builder.paint(image.number, image.camera, image.pose.T_world_cam, image.color);
    });
    const double covered = builder.coveredShare();
    return {builder.take(), covered};
}

std::string describe(const RunTexture& textured) {
    return formatted("%zu triangles, %.0f %% of them textured, texture of %d x %d pixels",
                     textured.mesh.triangles.size(), std::floor(100 * textured.covered_share),
                     textured.mesh.texture.cols, textured.mesh.texture.rows);
}

}  // namespace rgbd_graphslam
