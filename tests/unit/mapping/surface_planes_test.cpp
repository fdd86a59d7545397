#include "rgbd_graphslam/mapping/surface_planes.h"

#include <gtest/gtest.h>

#include <random>

namespace rgbd_graphslam {
namespace {

constexpr double voxel_m = 0.05;

/** Readings, put into cells of half a voxel as views do it. */
class Readings {
  public:
    void add(const Eigen::Vector3d& p, double range_m) {
        const Eigen::Vector3d at = p / cells.cellSize();
        const Eigen::Array3i cell = at.array().floor().cast<int>();
        const DepthNoise noise;
        const double sigmas = noise.sigma(range_m) / noise.sigma(1);
        SurfaceSample sample;
        sample.weight = static_cast<float>(1 / (sigmas * sigmas));
        sample.offset = sample.weight * (at - cell.cast<double>().matrix()).cast<float>();
        VoxelReadings in_voxel;
        in_voxel.add({cell.x(), cell.y(), cell.z()}, sample);
        cells.add({cell.x() >> 1, cell.y() >> 1, cell.z() >> 1}, in_voxel);
    }

    SurfaceCells cells{voxel_m / 2};
};

/** A wall of 2 x 2 m that stands along the voxels, a centimeter before the side of theirs. */
Readings wallSeenFrom(double range_m, int readings_a_voxel) {
    constexpr int voxels = 40;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(0, voxels * voxel_m);
    std::normal_distribution<double> error(0, DepthNoise().sigma(range_m));
    Readings readings;
    for (int i = 0; i < readings_a_voxel * voxels * voxels; ++i) {
        readings.add({0.8 * voxel_m + error(random), place(random), place(random)}, range_m);
    }
    return readings;
}

/** Of the voxels of a layer along the wall that hold readings, the share taken for surface. */
double shareOfLayer(const Readings& readings, int x) {
    const SurfacePlanes planes(readings.cells);
    int known = 0, crossed = 0;
    for (int y = 5; y < 35; ++y) {
        for (int z = 5; z < 35; ++z) {
            bool any = false;
            readings.cells.table().forEachWithin({2 * x, 2 * y, 2 * z},
                                                 {2 * x + 1, 2 * y + 1, 2 * z + 1},
                                                 [&](const auto&, const auto&) { any = true; });
            if (!any) continue;
            ++known;
            crossed += planes.cross({x, y, z});
        }
    }
    return static_cast<double>(crossed) / known;
}

TEST(SurfacePlanes, takeNoSpillOfANearWallForSurface) {
    const Readings wall = wallSeenFrom(1.5, 30);
    EXPECT_EQ(shareOfLayer(wall, 0), 1);
    EXPECT_LT(shareOfLayer(wall, 1), 0.05);
}

TEST(SurfacePlanes, takeLittleSpillOfAFarWallForSurface) {
    const Readings wall = wallSeenFrom(4.5, 20);
    EXPECT_GT(shareOfLayer(wall, 0), 0.9);
    EXPECT_LT(shareOfLayer(wall, 1), 0.3);
    EXPECT_LT(shareOfLayer(wall, 2), 0.05);
    EXPECT_LT(shareOfLayer(wall, -1), 0.05);
}

TEST(SurfacePlanes, keepAThingThatASingleNearReadingShows) {
    Readings one;
    one.add({0.01, 0.01, 0.01}, 1);
    EXPECT_TRUE(SurfacePlanes(one.cells).cross({0, 0, 0}));
}

TEST(SurfacePlanes, doNotBelieveASingleFarReading) {
    Readings one;
    one.add({0.01, 0.01, 0.01}, 5);
    EXPECT_FALSE(SurfacePlanes(one.cells).cross({0, 0, 0}));
}

TEST(SurfaceCells, keepWeightAndMeanWhenTheyAreMadeCoarser) {
    Readings readings;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-1, 1);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    constexpr int count = 500;
    for (int i = 0; i < count; ++i) {
        const Eigen::Vector3d p(place(random), place(random), place(random));
        readings.add(p, 1);
        sum += p;
    }
    const SurfaceCells coarse = readings.cells.coarser().coarser();
    EXPECT_EQ(coarse.cellSize(), 4 * readings.cells.cellSize());
    Eigen::Vector3d coarse_sum = Eigen::Vector3d::Zero();
    double weight = 0;
    for (const auto& [key, cell] : coarse.table().entries()) {
        const VoxelIndex v = voxelOfKey(key);
        coarse_sum += cell.weight * Eigen::Vector3d(v.x, v.y, v.z) + cell.offset.cast<double>();
        weight += cell.weight;
    }
    EXPECT_NEAR(weight, count, 1e-3);
    EXPECT_LT((coarse.cellSize() * coarse_sum - sum).norm(), 1e-3);
}

}  // namespace
}  // namespace rgbd_graphslam
