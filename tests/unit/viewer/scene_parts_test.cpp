#include "rgbd_graphslam/viewer/scene_parts.h"

#include <gtest/gtest.h>

#include <numeric>

namespace rgbd_graphslam {
namespace {

constexpr Rgba red = {255, 0, 0, 255};

Trajectory alongX(int n) {
    Trajectory poses;
    for (int i = 0; i < n; ++i) {
        poses.push_back({0.1 * i, SE3(Eigen::Matrix3d::Identity(), {0.5 * i, 0, 1})});
    }
    return poses;
}

std::size_t verticesOf(const std::array<Vertices, 6>& faces) {
    return std::accumulate(faces.begin(), faces.end(), std::size_t{0},
                           [](std::size_t sum, const Vertices& v) { return sum + v.size(); });
}

TEST(PathLines, joinConsecutivePoses) {
    const Vertices lines = pathLines(alongX(3), {}, red);
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(lines[1].position, lines[2].position);
    EXPECT_FLOAT_EQ(lines[3].position.x(), 1);
    EXPECT_EQ(lines[0].color, red);
    EXPECT_TRUE(pathLines(alongX(1), {}, red).empty());
    EXPECT_TRUE(pathLines({}, {}, red).empty());
}

TEST(PathLines, haveNoLengthAcrossLostFrames) {
    const Vertices lines = pathLines(alongX(4), {0.15}, red);  // poses at 0, 0.1, 0.2 and 0.3 s
    ASSERT_EQ(lines.size(), 6U);
    EXPECT_NE(lines[0].position, lines[1].position);
    EXPECT_EQ(lines[2].position, lines[3].position);
    EXPECT_NE(lines[4].position, lines[5].position);
}

TEST(FrustumLines, openTowardsWhatTheCameraSees) {
    const CameraModel camera;
    const Vertices lines = frustumLines(alongX(2), camera, 0.2, red);
    ASSERT_EQ(lines.size(), 2 * vertices_a_frustum);
    int at_eye = 0;
    for (std::size_t i = 0; i < vertices_a_frustum; ++i) {
        const float z = lines[i].position.z();  // the camera looks along +z from z = 1
        at_eye += z == 1.f;
        EXPECT_TRUE(z == 1.f || std::abs(z - 1.2f) < 1e-6f);
    }
    EXPECT_EQ(at_eye, 4);
    EXPECT_FLOAT_EQ(lines[vertices_a_frustum].position.x(), 0.5f);
}

TEST(EdgeLines, joinTheirKeyframes) {
    const Vertices lines = edgeLines(alongX(5), {{4, 1}}, red);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_FLOAT_EQ(lines[0].position.x(), 2);
    EXPECT_FLOAT_EQ(lines[1].position.x(), 0.5f);
}

TEST(OuterFaces, aLoneCellIsACube) {
    const auto faces = outerFaces({{{0.05f, 0.15f, 0.25f}, 0.1f, {1, 2, 3}}});
    for (int direction = 0; direction < 6; ++direction) {
        ASSERT_EQ(faces[direction].size(), 6U);
        const int axis = direction / 2;
        const float expected = 0.1f * static_cast<float>(axis) + (direction % 2 == 0 ? 0 : 0.1f);
        for (const Vertex& v : faces[direction]) EXPECT_NEAR(v.position[axis], expected, 1e-6f);
    }
    EXPECT_EQ(faces[0][0].color, (Rgba{1, 2, 3, 255}));
}

TEST(OuterFaces, sidesBetweenNeighborsAreLeftOut) {
    std::vector<OctreeCell> row;
    for (int i = -3; i < 5; ++i) {
        row.push_back({{0.1f * static_cast<float>(i) + 0.05f, 0.05f, -0.05f}, 0.1f, {}});
    }
    const auto faces = outerFaces(row);
    EXPECT_EQ(faces[0].size(), 6U);  // -x
    EXPECT_EQ(faces[1].size(), 6U);
    EXPECT_EQ(verticesOf(faces), 6U * (2 + 4 * row.size()));
}

TEST(OuterFaces, aLargeCellHidesTheSmallOnesBesideIt) {
    const auto faces =
        outerFaces({{{0.15f, 0.05f, 0.05f}, 0.1f, {}}, {{0.3f, 0.1f, 0.1f}, 0.2f, {}}});
    EXPECT_EQ(faces[0].size(), 12U);  // -x of both: the large one's is not covered whole
    EXPECT_EQ(faces[1].size(), 6U);   // +x of the large one only
    EXPECT_EQ(verticesOf(faces), 66U);
}

TEST(OuterFaces, fourSmallCellsHideALargeOnesSide) {
    std::vector<OctreeCell> cells = {{{0.1f, 0.1f, 0.1f}, 0.2f, {}}};
    for (int i = 0; i < 4; ++i) {
        cells.push_back({{-0.05f, 0.05f + 0.1f * static_cast<float>(i % 2),
                          0.05f + 0.1f * static_cast<float>(i / 2)},
                         0.1f,
                         {}});
    }
    const auto faces = outerFaces(cells);
    EXPECT_EQ(faces[0].size(), 4U * 6);  // of the small ones
    EXPECT_EQ(faces[1].size(), 6U);      // of the large one
}

TEST(GridTriangles, equalNeighborsShareARectangleAndUnseenCellsAreOpen) {
    GridMap grid;
    grid.width = 5, grid.height = 2;
    grid.resolution_m = 0.1, grid.x_min_m = -1, grid.y_min_m = 2;
    grid.free = {0.9f, 0.9f, 0.5f, 0.1f, 0.1f, 0.5f, 0.5f, 0.5f, 0.5f, 0.9f};
    const Vertices triangles = gridTriangles(grid);
    ASSERT_EQ(triangles.size(), 3U * 6);
    EXPECT_FLOAT_EQ(triangles[0].position.x(), -1);
    EXPECT_FLOAT_EQ(triangles[1].position.x(), -0.8f);
    EXPECT_GT(triangles[0].color[0], 200);
    EXPECT_FLOAT_EQ(triangles[6].position.x(), -0.7f);
    EXPECT_FLOAT_EQ(triangles[7].position.x(), -0.5f);
    EXPECT_LT(triangles[6].color[0], 60);
    EXPECT_FLOAT_EQ(triangles[12].position.y(), 2.1f);
}

TEST(MeshVertices, areBrighterTowardsTheLight) {
    PlyModel mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(meshVertices(mesh)[0].color, (Rgba{190, 190, 190, 255}));
    mesh.normals = {{0, 0, 1}, {0, 0, -1}};
    mesh.colors = {{10, 20, 30}, {10, 20, 30}};
    const Vertices vertices = meshVertices(mesh);
    ASSERT_EQ(vertices.size(), 2U);
    EXPECT_EQ(vertices[0].color[1], 20);
    EXPECT_GT(vertices[0].color[3], vertices[1].color[3] + 50);
    EXPECT_GT(vertices[1].color[3], 100);
}

TEST(FewerTriangles, spanTheSameSurface) {
    PlyModel mesh;  // a square of 1 m in steps of 1 cm
    constexpr std::uint32_t n = 101;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x)
            mesh.vertices.emplace_back(0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y),
                                       0.f);
    for (std::uint32_t y = 0; y + 1 < n; ++y) {
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t i = y * n + x;
            mesh.triangles.push_back({i, i + 1, i + n + 1});
            mesh.triangles.push_back({i, i + n + 1, i + n});
        }
    }
    EXPECT_EQ(fewerTriangles(mesh, 20000), mesh.triangles);
    const Triangles fewer = fewerTriangles(mesh, 1000);
    EXPECT_LE(fewer.size(), 1000U);
    EXPECT_GT(fewer.size(), 300U);
    double area = 0;
    for (const auto& [a, b, c] : fewer) {
        const Eigen::Vector3f u = mesh.vertices[b] - mesh.vertices[a],
                              v = mesh.vertices[c] - mesh.vertices[a];
        area += 0.5 * static_cast<double>(u.x() * v.y() - u.y() * v.x());  // none is turned over
    }
    EXPECT_NEAR(area, 1, 0.1);
    EXPECT_TRUE(fewerTriangles({}, 0).empty());
}

TEST(FloorLines, areOneAStep) {
    FloorGrid grid;
    grid.x_min_m = -1, grid.x_max_m = 1, grid.y_max_m = 1.5, grid.step_m = 0.5;
    const Vertices lines = floorLines(grid, red);
    ASSERT_EQ(lines.size(), 2U * (5 + 4));
    EXPECT_FLOAT_EQ(lines.front().position.x(), -1);
    EXPECT_FLOAT_EQ(lines.back().position.y(), 1.5f);
}

}  // namespace
}  // namespace rgbd_graphslam
