#include "rgbd_graphslam/viewer/map_export.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <iterator>
#include <type_traits>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/mesh_parts.h"

namespace rgbd_graphslam {
namespace {

/** Sets all voxels of a leaf, which may be a larger cube of them. */
template <class Tree, class Leaf>
void copyLeaf(const Leaf& leaf, unsigned depth, Tree& to) {
    const int side = 1 << (to.getTreeDepth() - depth);
    octomap::OcTreeKey key;
    for (int i = 0; i < side * side * side; ++i) {
        const int offset[] = {i % side, i / side % side, i / side / side};
        for (unsigned axis = 0; axis < 3; ++axis)
            key[axis] = static_cast<octomap::key_type>(leaf.getIndexKey()[axis] + offset[axis]);
        auto* node = to.setNodeValue(key, leaf->getLogOdds(), true);
        if constexpr (std::is_same_v<Tree, octomap::ColorOcTree>) node->setColor(leaf->getColor());
    }
}

/** A copy, since OctoMap 1.9 fails on an assertion when deleteNode() empties a branch. */
template <class Tree>
Tree cutAbove(const Tree& tree, double highest_m) {
    Tree cut(tree.getResolution());
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
        if (leaf.getZ() <= highest_m) copyLeaf(leaf, leaf.getDepth(), cut);
    }
    cut.updateInnerOccupancy();
    cut.prune();
    return cut;
}

}  // namespace

const char* extensionOf(ExportFormat format) {
    switch (format) {
        case ExportFormat::Ply:
        case ExportFormat::Mesh:
            return ".ply";
        case ExportFormat::Pcd:
            return ".pcd";
        case ExportFormat::ColorOctree:
            return ".ot";
        case ExportFormat::BinaryOctree:
            break;
    }
    return ".bt";
}

std::string freeName(const std::filesystem::path& folder, const std::string& stem,
                     const std::string& extension) {
    for (int number = 1;; ++number) {
        const auto path = folder / (stem + "-" + std::to_string(number) + extension);
        if (!std::filesystem::exists(path)) return path.string();
    }
}

void exportPoints(const Vertices& points, ExportFormat format, const std::string& path) {
    if (points.empty()) throw Error("no points are shown that could be written");
    PointMap map;
    map.reserve(points.size());
    for (const Vertex& point : points) {
        map.push_back({point.position, {point.color[0], point.color[1], point.color[2]}});
    }
    if (format == ExportFormat::Ply) return savePly(path, map);
    savePcd(path, map);
}

void exportMesh(const std::string& folder, double highest_m, const std::string& path) {
    const std::string from = folder + "/mesh.ply";
    if (!std::filesystem::exists(from))
        throw Error("this run has no mesh", "rgbd-map " + folder + " --mesh 0.02 makes one");
    const PlyModel mesh = readPly(from);
    std::vector<std::array<std::uint32_t, 3>> low;
    std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(low),
                 [&](const auto& triangle) {
                     return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
                         return static_cast<double>(mesh.vertices[v].z()) <= highest_m;
                     });
                 });
    if (low.empty()) throw Error("nothing of the mesh is below the ceiling that is cut off");
    PlyModel cut = meshOf(mesh, std::move(low));
    addNormals(cut);
    writePly(path, cut);
}

void exportOctree(const std::string& folder, double highest_m, ExportFormat format,
                  const std::string& path) {
    if (format == ExportFormat::ColorOctree)
        return saveColorOcTree(path, cutAbove(*loadColorOcTree(folder + "/octree.ot"), highest_m));
    saveBinaryOcTree(path, cutAbove(*loadBinaryOcTree(folder + "/octree.bt"), highest_m));
}

}  // namespace rgbd_graphslam
