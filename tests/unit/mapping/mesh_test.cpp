#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "../../support/problem_of.h"
#include "../../support/random_inputs.h"
#include "box_room.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/mesh_parts.h"
#include "rgbd_graphslam/mapping/surface_nets.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

constexpr double voxel_m = 0.02;
const cv::Vec3b bgr(30, 90, 200);

/** Distance along origin + distance * direction to the first surface; 0 where there is none. */
using Cast = std::function<double(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)>;

RgbdImage seen(const Cast& cast, const SE3& T_world_cam) {
    const CameraModel camera = smallCamera();
    RgbdImage image;
    image.depth_unit_m = 0.0002;
    image.depth = cv::Mat(camera.height, camera.width, CV_16UC1);
    image.color = cv::Mat(camera.height, camera.width, CV_8UC3, bgr);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const double z = cast(T_world_cam.t, T_world_cam.R * camera.unproject(u, v, 1));
            image.depth.at<std::uint16_t>(v, u) =
                static_cast<std::uint16_t>(std::lround(z / image.depth_unit_m));
        }
    }
    return image;
}

PlyModel meshOf(const Cast& cast, const std::vector<SE3>& views) {
    const RayTable rays(smallCamera());
    TsdfVolume volume(voxel_m);
    for (const SE3& T : views) volume.insert(T, DepthView(seen(cast, T), rays, MapOptions()));
    PlyModel mesh = surfaceOf(volume.blocks(), voxel_m);
    addNormals(mesh);
    return mesh;
}

/** From the middles of the sides, edges and corners of a cube round the origin. */
std::vector<SE3> viewsFromAround(double distance_m) {
    std::vector<SE3> views;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Eigen::Vector3d from = Eigen::Vector3d(x, y, z).normalized();
                const double yaw = std::atan2(-from.y(), -from.x()), down = std::asin(from.z());
                views.push_back(lookingAlong(distance_m * from, yaw, down));
            }
        }
    }
    return views;
}

constexpr double radius_m = 0.3;

double castSphere(const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius_m * radius_m;
    const double root = b * b - a * c;
    return root < 0 ? 0 : (-b - std::sqrt(root)) / a;
}

const Eigen::Vector3d half_box(0.25, 0.15, 0.31);

double castBox(const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const Eigen::Array3d a = (-half_box - o).array() / d.array(),
                         b = (half_box - o).array() / d.array();
    const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
    return enter < leave ? enter : 0;
}

double distanceToBox(const Eigen::Vector3d& p) {
    const Eigen::Array3d outside = p.array().abs() - half_box.array();
    return outside.maxCoeff() > 0 ? outside.max(0).matrix().norm() : -outside.maxCoeff();
}

/** How often each edge is run along, by its direction. */
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(const PlyModel& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    return edges;
}

/** Each edge is run along once in each direction: two triangles with the same side out. */
void expectClosed(const PlyModel& mesh) {
    const auto edges = edgesOf(mesh);
    ASSERT_FALSE(edges.empty());
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
}

double volumeInside(const PlyModel& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume +=
            static_cast<double>(mesh.vertices[a].cross(mesh.vertices[b]).dot(mesh.vertices[c])) / 6;
    }
    return volume;
}

/** Floor a little above the voxels' plane, and a wall far away. */
double castFloor(const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    constexpr double floor_m = 0.005, wall_m = 8;
    const double to_wall = (wall_m - o.x()) / d.x(), to_floor = (floor_m - o.z()) / d.z();
    return d.z() < 0 ? std::min(to_floor, to_wall) : to_wall;
}

/** Blocks that the image's lower border cuts off are looked through above the floor only. */
TEST(Mesh, aFloorThatLeavesTheImageKeepsItsSurface) {
    std::vector<SE3> views;
    for (int i = 0; i < 30; ++i) views.push_back(lookingAlong({0.1 * i, 0, 0.4}, 0, 0));
    const PlyModel mesh = meshOf(castFloor, views);
    constexpr double tile_m = 0.05;
    std::set<std::pair<int, int>> covered;
    for (const Eigen::Vector3f& p : mesh.vertices) {
        if (std::abs(p.z()) < voxel_m)
            covered.insert({std::lround(p.x() / tile_m), std::lround(p.y() / tile_m)});
    }
    int missing = 0;
    for (int x = 40; x < 70; ++x)  // 2 to 3.5 m: seen far ahead first, and at the border at last
        for (int y = -4; y <= 4; ++y) missing += 1 - static_cast<int>(covered.count({x, y}));
    EXPECT_EQ(missing, 0);
}

TEST(Mesh, ofASphereIsClosedAndRound) {
    const PlyModel mesh = meshOf(castSphere, viewsFromAround(1.2));
    expectClosed(mesh);
    // Euler: a sphere.
    EXPECT_EQ(2 * mesh.vertices.size(), mesh.triangles.size() + 4);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        ASSERT_NEAR(mesh.vertices[i].norm(), radius_m, 0.2 * voxel_m);
        ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), 0.97);
        ASSERT_EQ(mesh.colors[i], (std::array<std::uint8_t, 3>{200, 90, 30}));
    }
    constexpr double true_volume = 4 * M_PI / 3 * radius_m * radius_m * radius_m;
    EXPECT_NEAR(volumeInside(mesh), true_volume, 0.02 * true_volume);
}

TEST(Mesh, ofABoxIsClosedAndOnItsSides) {
    const PlyModel mesh = meshOf(castBox, viewsFromAround(1.3));
    expectClosed(mesh);
    std::size_t off_the_sides = 0;
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
        const double distance_m = distanceToBox(vertex.cast<double>());
        ASSERT_LT(distance_m, 0.6 * voxel_m);  // at corners, which it rounds
        off_the_sides += distance_m > 0.25 * voxel_m;
    }
    EXPECT_LT(off_the_sides, mesh.vertices.size() / 4) << off_the_sides;
    EXPECT_NEAR(volumeInside(mesh), 8 * half_box.prod(), 0.03 * 8 * half_box.prod());
}

TEST(Mesh, ofAPlaneIsFlatAndFacesTheCamera) {
    const double wall_m = 1.507;
    const auto wall = [&](const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
        return (wall_m - o.x()) / d.x();
    };
    const PlyModel mesh = meshOf(wall, {lookingAlong({0, 0, 0}, 0, 0)});
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Eigen::Vector3f cross =
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
        ASSERT_LT(cross.x(), 0);
        area += 0.5 * static_cast<double>(cross.norm());
    }
    for (const Eigen::Vector3f& vertex : mesh.vertices)
        ASSERT_NEAR(vertex.x(), wall_m, 0.02 * voxel_m);
    const Intrinsics camera = smallCamera().intrinsics();
    const double seen_m2 = camera.width / camera.fx * wall_m * camera.height / camera.fy * wall_m;
    EXPECT_NEAR(area, seen_m2, 0.05 * seen_m2);
}

TEST(Mesh, farFromTheOriginIsAsExact) {
    const Eigen::Vector3d far(5000, -7000, 300);
    std::vector<SE3> views = viewsFromAround(1.2);
    for (SE3& T : views) T.t += far;
    const PlyModel mesh = meshOf(
        [&](const Eigen::Vector3d& o, const Eigen::Vector3d& d) { return castSphere(o - far, d); },
        views);
    ASSERT_GT(mesh.vertices.size(), 1000u);
    for (const Eigen::Vector3f& vertex : mesh.vertices)
        ASSERT_NEAR((vertex.cast<double>() - far).norm(), radius_m, 0.2 * voxel_m);
}

/** Random signs everywhere: each way that surface can pass a cell, and each that two cells meet. */
TEST(Mesh, isClosedWhateverTheFieldIsLike) {
    RandomInputs random(7);
    TsdfVolume::BlockTable blocks;
    constexpr int size = TsdfVolume::block_size;
    for (int b = 0; b < 8; ++b) {
        auto block = std::make_unique<TsdfVolume::Block>();
        for (int i = 0; i < size * size * size; ++i) {
            const VoxelIndex v{size * (b & 1) + i % size, size * (b >> 1 & 1) + i / size % size,
                               size * (b >> 2) + i / (size * size)};
            const auto outside = [](int x) { return x == 0 || x == 2 * size - 1; };
            const bool free = outside(v.x) || outside(v.y) || outside(v.z) || random.index(2) == 0;
            block->voxels[i].weight = 1;
            block->voxels[i].distance_m =
                static_cast<float>((free ? 0.01 : -0.01) * random.uniform(0.1, 1));
        }
        blocks[voxelKey({b & 1, b >> 1 & 1, b >> 2})] = std::move(block);
    }
    const PlyModel mesh = surfaceOf(blocks, voxel_m);
    ASSERT_GT(mesh.triangles.size(), 5000u);
    const auto edges = edgesOf(mesh);
    std::size_t crowded = 0;
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        ASSERT_TRUE(back != edges.end());
        ASSERT_EQ(back->second, count);
        crowded += count > 1;
    }
    // Only where two cells with one sheet each meet at a face that the surface passes twice.
    RecordProperty("crowded", static_cast<int>(crowded));
    EXPECT_LT(crowded, edges.size() / 20);
}

/** Two triangles that share an edge, and one far off, of a sixth of the area. */
PlyModel threeTriangles() {
    PlyModel mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},    {1, 1, 0},
                     {9, 9, 9}, {5, 5, 5}, {5.3f, 5, 5}, {5, 6, 5}};
    for (std::uint8_t i = 0; i < 8; ++i) mesh.colors.push_back({i, i, i});
    mesh.triangles = {{5, 6, 7}, {0, 1, 2}, {1, 3, 2}};
    return mesh;
}

TEST(MeshParts, smallOnesGoAndTheRestIsCountedAnew) {
    const PlyModel mesh = withoutSmallParts(threeTriangles(), 0.2);
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[3], Eigen::Vector3f(1, 1, 0));
    EXPECT_EQ(mesh.colors[3][0], 3);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{1, 3, 2}));
}

TEST(MeshParts, vertexOfNoTriangleGoesInAnyCase) {
    const PlyModel mesh = withoutSmallParts(threeTriangles(), 0);
    EXPECT_EQ(mesh.vertices.size(), 7u);
    EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{4, 5, 6}));
    EXPECT_TRUE(withoutSmallParts(threeTriangles(), 2).vertices.empty());
    EXPECT_TRUE(withoutSmallParts({}, 0.1).triangles.empty());
}

TEST(MeshParts, normalsPointWhereTrianglesAreCounterClockwise) {
    PlyModel mesh = threeTriangles();
    addNormals(mesh);
    EXPECT_EQ(mesh.normals[1], Eigen::Vector3f(0, 0, 1));
    EXPECT_EQ(mesh.normals[4], Eigen::Vector3f(0, 0, 0));  // of no triangle
}

MapOptions withMesh(double edge_m = voxel_m) {
    MapOptions options;
    options.mesh_voxel_m = edge_m;
    return options;
}

/** Of a walk through the noisy room. */
PlyModel newMeshOfRoom() {
    const BoxRoom room;
    DenseMapper mapper(withMesh(), smallCamera());
    Noise noise;
    for (const SE3& T : walk(24)) mapper.insert(T, render(room, smallCamera(), T, 0, &noise));
    return mapper.mesh();
}

/** Made once: most tests only look. */
const PlyModel& meshOfRoom() {
    static const PlyModel mesh = newMeshOfRoom();
    return mesh;
}

TEST(MeshOfRoom, liesOnTheSurfaceMoreExactlyThanPointsDo) {
    const BoxRoom room;
    const PlyModel& mesh = meshOfRoom();
    ASSERT_GT(mesh.vertices.size(), 20000u);
    std::vector<double> errors;
    for (const Eigen::Vector3f& vertex : mesh.vertices)
        errors.push_back(room.distanceToSurface(vertex.cast<double>()));
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.002);
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.015);
}

TEST(MeshOfRoom, hasTheColorsOfItsSurfaces) {
    int table = 0;
    const PlyModel& mesh = meshOfRoom();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Eigen::Vector3f& p = mesh.vertices[i];
        const bool on_table = std::abs(p.z() - 0.74f) < 0.01f && p.x() > 1.3f && p.x() < 1.9f &&
                              std::abs(p.y()) < 0.5f;
        if (!on_table) continue;
        ++table;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(mesh.colors[i][c], (std::array{200, 60, 40})[c], 1);
    }
    EXPECT_GT(table, 1000);
}

TEST(MeshOfRoom, isTheSameEachRun) {
    const PlyModel &a = meshOfRoom(), b = newMeshOfRoom();
    EXPECT_TRUE(a.vertices == b.vertices);
    EXPECT_TRUE(a.triangles == b.triangles);
    EXPECT_TRUE(a.colors == b.colors);
}

TEST(MeshOfRoom, lensDistortionIsUndone) {
    Intrinsics camera = smallCamera().intrinsics();
    camera.lens = BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
    const BoxRoom room;
    DenseMapper mapper(withMesh(), camera);
    for (const SE3& T : walk(24)) mapper.insert(T, render(room, camera, T));
    std::vector<double> errors;
    for (const Eigen::Vector3f& vertex : mapper.mesh().vertices)
        errors.push_back(room.distanceToSurface(vertex.cast<double>()));
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.001);
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.01);
}

/** A person who stands in the way in a few views and is gone in most. */
TEST(MeshOfRoom, whoWalkedByIsLeftOut) {
    BoxRoom with_person;
    const Box person{{0.2, -0.3, 0}, {0.5, 0.0, 1.7}, {0, 255, 255}};
    with_person.furniture.push_back(person);
    const SE3 T = lookingAlong({-2, 0, 1.2}, 0, 0.2);
    const auto verticesOfPerson = [&](int views) {
        DenseMapper mapper(withMesh(), smallCamera());
        for (int i = 0; i < views; ++i)
            mapper.insert(T, render(i < 2 ? with_person : BoxRoom(), smallCamera(), T));
        const PlyModel mesh = mapper.mesh();
        return std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const auto& p) {
            return person.holds(p.template cast<double>(), -0.03) && p.z() > 0.1f;
        });
    };
    EXPECT_GT(verticesOfPerson(2), 500);
    EXPECT_EQ(verticesOfPerson(12), 0);
}

/** Triangles where the octree says that most views look through. */
int trianglesInFreeSpace(bool dropped) {
    BoxRoom with_person;
    with_person.furniture.push_back({{0.2, -0.3, 0}, {0.5, 0.0, 1.7}, {0, 255, 255}});
    MapOptions options = withMesh();
    options.drop_points_in_free_space = dropped;
    DenseMapper mapper(options, smallCamera());
    Noise noise;
    const auto poses = walk(24);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const BoxRoom room = i < 3 ? with_person : BoxRoom();
        mapper.insert(poses[i], render(room, smallCamera(), poses[i], 0, &noise));
    }
    const PlyModel mesh = mapper.mesh();
    const auto is_free = [&](std::uint32_t vertex) {
        const auto log_odds = mapper.volume().logOdds(mesh.vertices[vertex].cast<double>().eval());
        return log_odds && *log_odds < 0;
    };
    int count = 0;
    for (const auto& [a, b, c] : mesh.triangles) count += is_free(a) && is_free(b) && is_free(c);
    return count;
}

TEST(MeshOfRoom, nothingStandsInFreeSpace) {
    EXPECT_GT(trianglesInFreeSpace(false), 10);
    EXPECT_EQ(trianglesInFreeSpace(true), 0);
}

TEST(MeshOfRoom, tooFineAMeshIsRefusedWithTheResolutionThatFits) {
    MapOptions options = withMesh(0.005);
    options.point_voxel_m = 0.05;
    options.memory_limit_mb = 200;
    const auto refusal = [&] {
        return problemOf([&] {
            DenseMapper mapper(options, smallCamera());
            for (const SE3& T : walk(24)) {
                mapper.insert(T, render(BoxRoom(), smallCamera(), T));
                mapper.checkMemory();
            }
        });
    };
    const std::string problem = refusal();
    EXPECT_THAT(problem, testing::AllOf(testing::HasSubstr("mesh_voxel_m to"),
                                        testing::Not(testing::HasSubstr("point_voxel_m"))));
    const double advised = std::strtod(problem.c_str() + problem.find(" to ") + 4, nullptr);
    EXPECT_GT(advised, 0.005);
    EXPECT_LT(advised, 0.05);
}

TEST(MeshOfRoom, finerThanDepthImagesIsRefused) {
    EXPECT_THAT(problemOf([] { DenseMapper(withMesh(0.001), smallCamera()); }),
                testing::AllOf(testing::HasSubstr("0.001 m"), testing::HasSubstr("0.005")));
}

TEST(MeshOfRoom, isNotThereUnlessAskedFor) {
    DenseMapper mapper({}, smallCamera());
    EXPECT_FALSE(mapper.hasMesh());
    EXPECT_EQ(mapper.meshBytes(), 0u);
    EXPECT_THAT(problemOf([&] { mapper.mesh(); }), testing::HasSubstr("mesh_voxel_m"));
}

TEST(MeshOfRoom, poseOutOfReachIsRefused) {
    TsdfVolume volume(voxel_m);
    const RayTable rays(smallCamera());
    const SE3 far(Eigen::Matrix3d::Identity(), {30000, 0, 0});
    EXPECT_THAT(problemOf([&] {
                    volume.insert(far, DepthView(render(BoxRoom(), smallCamera(), SE3()), rays,
                                                 MapOptions()));
                }),
                testing::HasSubstr("out of reach"));
}

}  // namespace
}  // namespace rgbd_graphslam
