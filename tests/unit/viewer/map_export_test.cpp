#include "rgbd_graphslam/viewer/map_export.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/mesh_parts.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class MapExport : public testing::Test {
  protected:
    MapExport() { fs::create_directories(folder_); }
    ~MapExport() override { fs::remove_all(folder_); }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    fs::path folder_ = fs::path(testing::TempDir()) / ("rgbd-export-" + std::to_string(getpid()));
};

/** Occupied at three heights, free below them. */
template <class Tree>
void fill(Tree& tree) {
    for (const float z : {0.5f, 1.5f, 2.5f}) {
        for (int i = 0; i < 3; ++i) tree.updateNode(octomap::point3d(1, 1, z), true);
        tree.updateNode(octomap::point3d(1, 1, z - 0.3f), false);
    }
    tree.updateInnerOccupancy();
}

TEST_F(MapExport, pointsKeepPlaceAndColor) {
    const Vertices points = {{{1, 2, 3}, {4, 5, 6, 255}}, {{-1, 0, 2.5f}, {7, 8, 9, 255}}};
    exportPoints(points, ExportFormat::Ply, path("a.ply"));
    const PointMap read = loadPly(path("a.ply"));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[1].position, points[1].position);
    EXPECT_EQ(read[0].rgb, (std::array<std::uint8_t, 3>{4, 5, 6}));
    exportPoints(points, ExportFormat::Pcd, path("a.pcd"));
    std::string first_line;
    std::ifstream pcd(path("a.pcd"));
    std::getline(pcd, first_line);
    EXPECT_NE(first_line.find("PCD"), std::string::npos);
}

TEST_F(MapExport, anEmptyCloudIsRefused) {
    EXPECT_THROW(exportPoints({}, ExportFormat::Ply, path("a.ply")), Error);
    EXPECT_FALSE(fs::exists(path("a.ply")));
}

TEST_F(MapExport, octreesLoseWhatIsCutOff) {
    octomap::ColorOcTree color(0.1);
    octomap::OcTree binary(0.1);
    fill(color);
    fill(binary);
    saveColorOcTree(path("octree.ot"), color);
    saveBinaryOcTree(path("octree.bt"), binary);
    exportOctree(folder_.string(), 2, ExportFormat::ColorOctree, path("cut.ot"));
    exportOctree(folder_.string(), 2, ExportFormat::BinaryOctree, path("cut.bt"));
    const auto cut_color = loadColorOcTree(path("cut.ot"));
    const auto cut_binary = loadBinaryOcTree(path("cut.bt"));
    EXPECT_EQ(cut_color->getNumLeafNodes(), 4U);
    EXPECT_EQ(cut_binary->getNumLeafNodes(), 4U);
    EXPECT_EQ(cut_color->search(1, 1, 2.5), nullptr);
    ASSERT_NE(cut_color->search(1, 1, 1.5), nullptr);
    EXPECT_TRUE(cut_color->isNodeOccupied(cut_color->search(1, 1, 1.5)));
}

TEST_F(MapExport, leavesThatWereMergedStayWhole) {
    octomap::OcTree tree(0.1);
    for (int i = 0; i < 8; ++i) {
        tree.updateNode(octomap::point3d(0.05f + 0.1f * static_cast<float>(i & 1),
                                         0.05f + 0.1f * static_cast<float>(i >> 1 & 1),
                                         0.05f + 0.1f * static_cast<float>(i >> 2)),
                        false);
    }
    tree.prune();
    ASSERT_EQ(tree.getNumLeafNodes(), 1U);
    saveBinaryOcTree(path("octree.bt"), tree);
    exportOctree(folder_.string(), 2, ExportFormat::BinaryOctree, path("cut.bt"));
    const auto cut = loadBinaryOcTree(path("cut.bt"));
    EXPECT_EQ(cut->getNumLeafNodes(), 1U);
    EXPECT_DOUBLE_EQ(cut->begin_leafs().getSize(), 0.2);
}

TEST_F(MapExport, aRunWithoutOctreeIsNamed) {
    EXPECT_THROW(exportOctree(folder_.string(), 2, ExportFormat::ColorOctree, path("cut.ot")),
                 Error);
}

TEST_F(MapExport, theMeshLosesWhatIsCutOff) {
    PlyModel mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}};
    mesh.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
    mesh.triangles = {{0, 1, 3}, {0, 1, 2}};
    addNormals(mesh);
    writePly(path("mesh.ply"), mesh);
    exportMesh(folder_.string(), 2, path("cut.ply"));
    const PlyModel cut = readPly(path("cut.ply"));
    ASSERT_EQ(cut.triangles.size(), 1U);
    EXPECT_EQ(cut.vertices.size(), 3U);
    EXPECT_EQ(cut.colors[2], mesh.colors[2]);
    EXPECT_EQ(cut.normals[0], Eigen::Vector3f(0, 0, 1));
    EXPECT_THROW(exportMesh(folder_.string(), -1, path("none.ply")), Error);
    EXPECT_FALSE(fs::exists(path("none.ply")));
}

TEST_F(MapExport, aRunWithoutMeshIsTold) {
    EXPECT_THROW(exportMesh(folder_.string(), 2, path("cut.ply")), Error);
}

TEST_F(MapExport, namesThatAreTakenArePassedOver) {
    EXPECT_EQ(freeName(folder_, "view", ".png"), path("view-1.png"));
    std::ofstream(path("view-1.png")) << "taken";
    EXPECT_EQ(freeName(folder_, "view", ".png"), path("view-2.png"));
    EXPECT_EQ(freeName("", "no-such-name", ".x"), "no-such-name-1.x");
}

}  // namespace
}  // namespace rgbd_graphslam
