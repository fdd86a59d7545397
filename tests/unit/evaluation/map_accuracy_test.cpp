#include "rgbd_graphslam/evaluation/map_accuracy.h"

#include <gtest/gtest.h>

#include "../../support/made_trajectories.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** The square [0, 1]^2 at z = 0, as two triangles. */
PlyModel square() {
    PlyModel model;
    model.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    model.triangles = {{0, 1, 2}, {0, 2, 3}};
    return model;
}

/** Points every centimeter over [0, width] x [0, 1] at one height. */
PlyModel gridAt(float z, int width_cm = 100) {
    PlyModel model;
    for (int i = 0; i <= width_cm; ++i) {
        for (int j = 0; j <= 100; ++j) model.vertices.emplace_back(i * 0.01f, j * 0.01f, z);
    }
    return model;
}

TEST(MapAccuracy, isTheDistanceToTheTriangles) {
    const auto accuracy = evaluateMap(gridAt(0.015f), square());
    EXPECT_NEAR(accuracy.distance_m.min, 0.015, 1e-6);
    EXPECT_NEAR(accuracy.distance_m.max, 0.015, 1e-6);
    EXPECT_NEAR(accuracy.distance_95_m, 0.015, 1e-6);
    EXPECT_EQ(accuracy.completeness, 1);
}

TEST(MapAccuracy, ofPointsBesideATriangleIsToItsEdgeOrCorner) {
    PlyModel map;
    map.vertices = {{2, 0.5f, 0}};
    EXPECT_NEAR(evaluateMap(map, square()).distance_m.mean, 1, 1e-6);
    map.vertices = {{4, 5, 0}};
    EXPECT_NEAR(evaluateMap(map, square()).distance_m.mean, 5, 1e-6);
}

TEST(MapAccuracy, completenessIsTheShareOfTheAreaThatIsCovered) {
    const auto accuracy = evaluateMap(gridAt(0, 48), square());
    EXPECT_NEAR(accuracy.completeness, 0.50, 0.005);  // 0.48 m and 2 cm beyond
    EXPECT_GT(accuracy.surface_samples, 10000u);
}

TEST(MapAccuracy, tellsTheShareOfPointsFarFromTheSurfaceAndOnMoversWays) {
    PlyModel map;
    map.vertices = {{0.5f, 0.5f, 0}, {0.5f, 0.5f, 0.09f}, {0.5f, 0.5f, 0.2f}, {0.1f, 0.1f, 0.5f}};
    MoverBox box;
    box.T_world_box.t = {0.5, 0.5, 0};
    box.size_m = {0.2, 0.2, 1};
    box.speed_m_s = 1;
    const MoverWays ways({box});
    MapAccuracyOptions options;
    EXPECT_FALSE(evaluateMap(map, square(), options).on_movers_ways);
    options.movers = &ways;
    EXPECT_EQ(evaluateMap(map, square(), options).beyond, 0.5);
    EXPECT_EQ(evaluateMap(map, square(), options).on_movers_ways.value(), 0.25);
    options.beyond_m = 0.05;
    EXPECT_EQ(evaluateMap(map, square(), options).beyond, 0.75);
}

TEST(MapAccuracy, completenessDoesNotDependOnHowTheSurfaceIsCut) {
    PlyModel slivers = square();
    // The covered half as two triangles, the other as many thin ones.
    slivers.vertices = {{0, 0, 0}, {0.5f, 0, 0}, {0.5f, 1, 0}, {0, 1, 0}};
    for (int k = 0; k <= 50; ++k) {
        slivers.vertices.emplace_back(0.5f, k * 0.02f, 0);
        slivers.vertices.emplace_back(1, k * 0.02f, 0);
        const auto n = static_cast<std::uint32_t>(slivers.vertices.size());
        if (k == 0) continue;
        slivers.triangles.push_back({n - 4, n - 3, n - 2});
        slivers.triangles.push_back({n - 3, n - 2, n - 1});
    }
    EXPECT_NEAR(evaluateMap(gridAt(0, 48), slivers).completeness, 0.50, 0.005);
}

TEST(MapAccuracy, takesASurfaceOfPoints) {
    const auto accuracy = evaluateMap(gridAt(0.01f, 50), gridAt(0));
    EXPECT_NEAR(accuracy.distance_m.mean, 0.01, 1e-6);
    EXPECT_NEAR(accuracy.completeness, 52 / 101.0, 1e-9);
    EXPECT_EQ(accuracy.surface_samples, 101u * 101u);
}

TEST(MapAccuracy, movesTheMapFirst) {
    PlyModel map = gridAt(0);
    for (auto& vertex : map.vertices) {
        vertex = (someMotion().inverse() * Eigen::Vector3d(vertex.cast<double>())).cast<float>();
    }
    MapAccuracyOptions options;
    options.alignment.motion = someMotion();
    EXPECT_LT(evaluateMap(map, square(), options).distance_m.max, 1e-5);
}

/** Points on a sphere: the tree must find among many triangles what a search of all finds. */
TEST(MapAccuracy, findsTheNearestOfManyTriangles) {
    PlyModel sphere;
    constexpr int rings = 30, around = 60;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j < around; ++j) {
            const double a = M_PI * i / rings, b = 2 * M_PI * j / around;
            sphere.vertices.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                                         std::cos(a));
        }
    }
    PlyModel map;
    double nearest_expected = 0;
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            const std::uint32_t a = i * around + j, b = i * around + (j + 1) % around;
            sphere.triangles.push_back({a, b, a + around});
            sphere.triangles.push_back({b, b + around, a + around});
            // Just outside the corner a, in its own direction, nothing is nearer than the corner.
            map.vertices.push_back(sphere.vertices[a] * 1.25f);
            nearest_expected += 0.25;
        }
    }
    const auto errors = evaluateMap(map, sphere).distance_m;
    EXPECT_NEAR(errors.mean, nearest_expected / map.vertices.size(), 1e-6);
    EXPECT_NEAR(errors.min, 0.25, 1e-6);
    EXPECT_NEAR(errors.max, 0.25, 1e-6);
}

TEST(MapAccuracy, refusesASurfaceThatIsNotInMetres) {
    PlyModel millimeters = square();
    for (auto& vertex : millimeters.vertices) vertex *= 1e6f;
    EXPECT_THROW(evaluateMap(gridAt(0, 1), millimeters), Error);
}

TEST(MapAccuracy, refusesAnEmptyMapAndDistancesThatAreNone) {
    EXPECT_THROW(evaluateMap({}, square()), Error);
    MapAccuracyOptions options;
    options.completeness_distance_m = 0;
    EXPECT_THROW(evaluateMap(square(), square(), options), Error);
}

/** Looking straight down from above the middle of the square. */
Trajectory aboveAt(double height_m) {
    Trajectory poses(1);
    poses[0].T_world_cam.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
    poses[0].T_world_cam.t = {0.5, 0.5, height_m};
    return poses;
}

TEST(SurfaceSight, endsAtTheImageTheRangeAndWhatStandsBefore) {
    PlyModel surface = square();
    surface.vertices.insert(surface.vertices.end(),
                            {{0, 0, 0.5f}, {0.4f, 0, 0.5f}, {0, 0.4f, 0.5f}});
    surface.triangles.push_back({4, 5, 6});  // hides a corner
    const SurfaceSight sight(surface, CameraModel(), aboveAt(2));
    EXPECT_TRUE(sight.sees({0.5, 0.5, 0}));
    EXPECT_TRUE(sight.sees({0.1, 0.1, 0.5}));
    EXPECT_FALSE(sight.sees({0.05, 0.05, 0}));
    EXPECT_FALSE(SurfaceSight(surface, CameraModel(), aboveAt(6)).sees({0.5, 0.5, 0}));
    EXPECT_FALSE(SurfaceSight(surface, CameraModel(), aboveAt(0.5)).sees({0.99, 0.5, 0}));
    EXPECT_THROW(SurfaceSight(gridAt(0), CameraModel(), aboveAt(2)), Error);
}

TEST(SurfaceSight, leavesOutWhatIsSeenTooFlat) {
    SightOptions options;
    options.max_incidence_deg = 20;  // reaches tan(20 deg) * 2 m = 0.73 m around the middle
    PlyModel wide = square();
    for (auto& vertex : wide.vertices) vertex.head<2>() = 4 * vertex.head<2>().array() - 1.5f;
    const SurfaceSight sight(wide, CameraModel(), aboveAt(2), options);
    EXPECT_TRUE(sight.sees({0.5 + 0.70, 0.5, 0}));
    EXPECT_FALSE(sight.sees({0.5 + 0.76, 0.5, 0}));
    EXPECT_TRUE(SurfaceSight(wide, CameraModel(), aboveAt(2)).sees({0.5 + 0.76, 0.5, 0}));
}

TEST(MapAccuracy, completenessOfSeenLeavesOutWhatWasHidden) {
    PlyModel surface = square();
    for (const auto& vertex : square().vertices) {
        surface.vertices.push_back(vertex - Eigen::Vector3f(0, 0, 0.3f));
    }
    surface.triangles.push_back({4, 5, 6});
    surface.triangles.push_back({4, 6, 7});
    const SurfaceSight sight(surface, CameraModel(), aboveAt(3));
    MapAccuracyOptions options;
    options.sight = &sight;
    const auto accuracy = evaluateMap(gridAt(0), surface, options);
    EXPECT_NEAR(accuracy.completeness, 0.5, 1e-6);
    ASSERT_TRUE(accuracy.completeness_of_seen);
    EXPECT_NEAR(*accuracy.completeness_of_seen, 1, 1e-6);
    EXPECT_FALSE(evaluateMap(gridAt(0), surface).completeness_of_seen);
}

}  // namespace
}  // namespace rgbd_graphslam
