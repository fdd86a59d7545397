#include "run_mesh.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

PlyModel readRunMesh(const std::string& run_folder) {
    const auto path = std::filesystem::path(run_folder) / "mesh.ply";
    const std::string remedy = "make it with: rgbd-map " + run_folder + " --mesh 0.02";
    if (!std::filesystem::exists(path)) throw Error("'" + run_folder + "' has no mesh.ply", remedy);
    PlyModel mesh = readPly(path.string());
    if (mesh.triangles.empty() || mesh.colors.empty())
        throw Error("'" + path.string() + "' has no triangles or no colors", remedy);
    return mesh;
}

}  // namespace rgbd_graphslam
