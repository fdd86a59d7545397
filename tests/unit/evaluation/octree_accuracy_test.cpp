#include "rgbd_graphslam/evaluation/octree_accuracy.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

namespace rgbd_graphslam {
namespace {

constexpr float low = 0.02f, high = 0.98f;

/** A wall of 1 x 1 m at x = 0.52, within the voxels from 0.5 to 0.55 m. */
PlyModel wall() {
    PlyModel surface;
    surface.vertices = {
        {0.52f, low, low}, {0.52f, high, low}, {0.52f, high, high}, {0.52f, low, high}};
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    return surface;
}

/** Free before the layer of voxels of the wall, that layer occupied. */
octomap::OcTree mapOfWall() {
    octomap::OcTree tree(0.05);
    for (int x = 0; x <= 10; ++x) {
        for (int y = 0; y < 20; ++y) {
            for (int z = 0; z < 20; ++z)
                tree.updateNode(0.05 * x + 0.025, 0.05 * y + 0.025, 0.05 * z + 0.025, x == 10);
        }
    }
    tree.prune();
    return tree;
}

TEST(OctreeAccuracy, isFullForAPerfectMapHoweverPruned) {
    const auto accuracy = evaluateOctree(mapOfWall(), wall(), {}, 0.01);
    EXPECT_EQ(accuracy.surface_voxels, 400u);
    EXPECT_EQ(accuracy.free_voxels, 4000u);
    EXPECT_EQ(accuracy.surface_occupied, 1);
    EXPECT_EQ(accuracy.free_occupied, 0);
}

TEST(OctreeAccuracy, countsMissedSurfaceAndGhosts) {
    auto tree = mapOfWall();
    for (int i = 0; i < 20; ++i) {
        tree.setNodeValue(0.525, 0.05 * i + 0.025, 0.025, -1.f);  // one row of 20
        tree.setNodeValue(0.125, 0.05 * i + 0.025, 0.025, 1.f);
    }
    const auto accuracy = evaluateOctree(tree, wall(), {}, 0.01);
    EXPECT_DOUBLE_EQ(accuracy.surface_occupied, 0.95);
    EXPECT_DOUBLE_EQ(accuracy.free_occupied, 20. / 4000);
}

TEST(OctreeAccuracy, toleranceForgivesTheNeighboringVoxel) {
    PlyModel surface = wall();
    for (auto& vertex : surface.vertices) vertex.x() = 0.495f;
    const auto accuracy = evaluateOctree(mapOfWall(), surface, {}, 0.01);
    EXPECT_EQ(accuracy.surface_occupied, 0);
    EXPECT_EQ(accuracy.surface_occupied_within_tolerance, 1);
    EXPECT_EQ(accuracy.free_occupied, 0);
}

TEST(OctreeAccuracy, weighsTheSeenSurfaceByItsAreaInTheVoxels) {
    // The lowest row of voxels holds 3 cm of the wall's height, the others 5.
    octomap::OcTree tree(0.05);
    for (int y = 0; y < 20; ++y) {
        for (int z = 1; z < 20; ++z)
            tree.updateNode(0.525, 0.05 * y + 0.025, 0.05 * z + 0.025, true);
    }
    Trajectory before(1);  // looks along +x at the middle of the wall
    before[0].T_world_cam.R = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
    before[0].T_world_cam.t = {-1.5, 0.5, 0.5};
    const SurfaceSight sight(wall(), CameraModel(), before);
    EXPECT_FALSE(evaluateOctree(tree, wall(), {}, 0.01).seen);
    const auto seen = evaluateOctree(tree, wall(), {}, 0.001, &sight).seen;
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->area_m2, 0.96 * 0.96, 1e-6);
    EXPECT_NEAR(seen->occupied, 1 - 0.03 / 0.96, 0.005);
    EXPECT_EQ(seen->free, 0);
    EXPECT_NEAR(evaluateOctree(tree, wall(), {}, 0.031, &sight).seen->occupied_within_tolerance, 1,
                0.005);
    for (int y = 0; y < 20; ++y) tree.updateNode(0.525, 0.05 * y + 0.025, 0.025, false);
    EXPECT_NEAR(evaluateOctree(tree, wall(), {}, 0.001, &sight).seen->free, 0.03 / 0.96, 0.005);
}

TEST(OctreeAccuracy, movesTheMapOntoTheTruth) {
    PlyModel surface = wall();
    for (auto& vertex : surface.vertices) vertex += Eigen::Vector3f(3, -2, 1);
    Similarity truth_from_map;
    truth_from_map.motion.t = {3, -2, 1};
    EXPECT_EQ(evaluateOctree(mapOfWall(), surface, truth_from_map, 0.01).surface_occupied, 1);
}

}  // namespace
}  // namespace rgbd_graphslam
