#include "rgbd_graphslam/mapping/dense_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>

#include "../../support/problem_of.h"
#include "box_room.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/view_coverage.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

struct Mapped {
    explicit Mapped(bool noisy, const MapOptions& options = {}, CameraModel camera = smallCamera())
        : mapper(options, camera) {
        Noise noise;
        for (const SE3& T : walk(24))
            mapper.insert(T, render(room, camera, T, 0, noisy ? &noise : nullptr));
        mapper.finish();
    }
    BoxRoom room;
    DenseMapper mapper;
};

/** Made once: most tests only look. */
const Mapped& exactMap() {
    static const Mapped map(false);
    return map;
}
const Mapped& noisyMap() {
    static const Mapped map(true);
    return map;
}

/** \param share 0.5 for the median */
double quantile(std::vector<double> values, double share) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

std::vector<double> pointErrors(const Mapped& map) {
    std::vector<double> errors;
    for (const MapPoint& point : map.mapper.points()) {
        errors.push_back(map.room.distanceToSurface(point.position.cast<double>()));
    }
    return errors;
}

/** Of the leaves of 5 cm whose state is certain in truth, the shares found right. */
struct LeafShares {
    double surface_occupied, free_occupied, free_known;
};

LeafShares leafShares(const Mapped& map) {
    const auto& volume = map.mapper.volume();
    const double r = volume.resolution();
    int surface = 0, occupied = 0, free = 0, wrong = 0, known = 0;
    for (double x = -2.95; x < 3; x += r) {
        for (double y = -1.95; y < 2; y += r) {
            // What is well above the floor and below the ceiling has been in sight of the walk.
            for (double z = 0.05; z < 1.8; z += r) {
                const Eigen::Vector3d corner(x + 1e-3, y + 1e-3, z + 1e-3);
                const Eigen::Vector3d center = r * ((corner / r).array().floor() + 0.5);
                if (!map.room.isFree(center, 0.87 * r)) continue;
                const auto log_odds = volume.logOdds(center);
                ++free;
                known += log_odds.has_value();
                wrong += log_odds && *log_odds >= 0;
            }
        }
    }
    // Truth of the surface: where the camera's rays end.
    const CameraModel camera = smallCamera();
    for (const SE3& T : walk(24)) {
        for (int v = 4; v < camera.height; v += 8) {
            for (int u = 4; u < camera.width; u += 8) {
                const Eigen::Vector3d ray = T.R * camera.unproject(u, v, 1);
                const auto hit = map.room.cast(T.t, ray);
                ++surface;
                // Walls lie on leaf boundaries here: just behind is the same surface.
                const auto log_odds_front =
                    volume.logOdds(Eigen::Vector3d(T.t + (hit.distance - 1e-3) * ray));
                const auto log_odds_back =
                    volume.logOdds(Eigen::Vector3d(T.t + (hit.distance + 1e-3) * ray));
                occupied += (log_odds_front && *log_odds_front >= 0) ||
                            (log_odds_back && *log_odds_back >= 0);
            }
        }
    }
    return {double(occupied) / surface, double(wrong) / free, double(known) / free};
}

TEST(DenseMapper, pointsLieOnTheSurface) {
    EXPECT_LT(quantile(pointErrors(exactMap()), 0.95), 0.001);
    EXPECT_LT(quantile(pointErrors(noisyMap()), 0.5), 0.008);
    EXPECT_LT(quantile(pointErrors(noisyMap()), 0.95), 0.04);
}

TEST(DenseMapper, octreeTellsSurfaceFromFreeSpace) {
    for (const Mapped* map : {&exactMap(), &noisyMap()}) {
        const LeafShares shares = leafShares(*map);
        EXPECT_GT(shares.surface_occupied, 0.97);
        EXPECT_LT(shares.free_occupied, 0.01);
        EXPECT_GT(shares.free_known, 0.9);
    }
}

/** A noisy map of another room, before finish(). */
DenseMapper unfinishedMap(const BoxRoom& room) {
    DenseMapper mapper({}, smallCamera());
    Noise noise;
    for (const SE3& T : walk(24)) mapper.insert(T, render(room, smallCamera(), T, 0, &noise));
    return mapper;
}

/** Occupied voxels along a line, at the centers of those it starts in. */
int occupiedAlong(const OccupancyVolume& volume, Eigen::Vector3d place, int axis, int voxels) {
    int occupied = 0;
    for (int i = 0; i < voxels; ++i, place[axis] += volume.resolution()) {
        const auto log_odds = volume.logOdds(place);
        occupied += log_odds && *log_odds >= 0;
    }
    return occupied;
}

TEST(DenseMapper, noiseThatSpillsIntoTheNextVoxelsIsTakenBack) {
    BoxRoom room;
    room.walls.high.x() = 2.008;  // 8 mm within its voxels
    DenseMapper mapper = unfinishedMap(room);
    const Eigen::Vector3d before(1.975, -0.975, 1.525), inside(2.025, -0.975, 1.525);
    ASSERT_GT(occupiedAlong(mapper.volume(), before, 1, 40), 20);
    mapper.finish();
    EXPECT_LT(occupiedAlong(mapper.volume(), before, 1, 40), 4);
    EXPECT_EQ(occupiedAlong(mapper.volume(), inside, 1, 40), 40);
}

TEST(DenseMapper, noiseOfAWallThatIsSeenFromAfarOnlyIsTakenBack) {
    BoxRoom room;
    room.walls.high.x() = 2.008;  // 8 mm within its voxels
    room.furniture.clear();
    DenseMapper mapper({}, smallCamera());
    Noise noise;
    for (const double y : {-0.4, 0., 0.4}) {
        const SE3 T = lookingAlong({-2.4, y, 1.2}, 0, 0);
        mapper.insert(T, render(room, smallCamera(), T, 0, &noise));
    }
    const Eigen::Vector3d before(1.975, -0.975, 1.525), inside(2.025, -0.975, 1.525);
    const int spilled = occupiedAlong(mapper.volume(), before, 1, 40);
    const int surface = occupiedAlong(mapper.volume(), inside, 1, 40);
    ASSERT_GT(spilled, 20);
    mapper.finish();
    EXPECT_LT(occupiedAlong(mapper.volume(), before, 1, 40), spilled / 3);
    EXPECT_GT(occupiedAlong(mapper.volume(), inside, 1, 40), surface - 4);
}

TEST(DenseMapper, thinThingsAreNoSpill) {
    BoxRoom room;
    room.furniture.push_back({{0.856, -0.144, 0}, {0.894, -0.106, 1.6}, {0, 0, 0}});  // a pole
    DenseMapper mapper = unfinishedMap(room);
    const Eigen::Vector3d foot(0.875, -0.125, 0.325);
    const int occupied = occupiedAlong(mapper.volume(), foot, 2, 24);
    EXPECT_GE(occupied, 22);
    mapper.finish();
    EXPECT_EQ(occupiedAlong(mapper.volume(), foot, 2, 24), occupied);
}

TEST(DenseMapper, pointsHaveTheColorsOfTheirSurfaces) {
    const Mapped& map = exactMap();
    int table = 0;
    for (const MapPoint& point : map.mapper.points()) {
        const bool on_table = std::abs(point.position.z() - 0.74f) < 0.002f;
        if (!on_table || point.position.x() < 1.25f || std::abs(point.position.y()) > 0.55f)
            continue;
        if (point.position.x() > 1.95f) continue;
        ++table;
        ASSERT_EQ(point.rgb, (std::array<std::uint8_t, 3>{200, 60, 40}));
    }
    EXPECT_GT(table, 1000);
}

TEST(DenseMapper, lensDistortionIsUndone) {
    Intrinsics camera = smallCamera().intrinsics();
    camera.lens = BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
    const Mapped map(false, MapOptions(), camera);
    EXPECT_LT(quantile(pointErrors(map), 0.95), 0.002);
    EXPECT_GT(leafShares(map).surface_occupied, 0.97);
    EXPECT_LT(leafShares(map).free_occupied, 0.01);
}

TEST(DenseMapper, gridShowsFurnitureWallsAndFreeFloor) {
    const Mapped& map = noisyMap();
    mrpt::maps::COccupancyGridMap2D grid;
    map.mapper.grid(grid);
    int free = 0, free_right = 0;
    for (float x = -2.9f; x < 2.9f; x += 0.05f) {
        for (float y = -1.9f; y < 1.9f; y += 0.05f) {
            if (!map.room.isFree(Eigen::Vector3d(x, y, 0.3), 0.08)) continue;
            ++free;
            free_right += grid.getPos(x, y) > 0.75f;
        }
    }
    EXPECT_GT(free_right, 0.9 * free);
    for (const Box& box : map.room.furniture) {
        // The side that faces the room's middle is an obstacle.
        const Eigen::Vector3d center = 0.5 * (box.low + box.high);
        EXPECT_LT(grid.getPos(static_cast<float>(center.x()), static_cast<float>(center.y())),
                  0.75f);
        int obstacle = 0;
        for (double x = box.low.x() - 0.03; x < box.high.x() + 0.03; x += 0.025) {
            for (double y = box.low.y() - 0.03; y < box.high.y() + 0.03; y += 0.025) {
                obstacle += grid.getPos(static_cast<float>(x), static_cast<float>(y)) < 0.35f;
            }
        }
        EXPECT_GT(obstacle, 50);
    }
    // Outside the room nothing was seen.
    EXPECT_NEAR(grid.getPos(3.4f, 0.f), 0.5f, 1e-3f);
}

TEST(DenseMapper, gridCellsAreTheLeavesBelowThem) {
    const auto& volume = noisyMap().mapper.volume();
    mrpt::maps::COccupancyGridMap2D grid;
    noisyMap().mapper.grid(grid);
    EXPECT_EQ(grid.getSizeX() % 8, 0u);  // whole blocks of the volume
    EXPECT_EQ(grid.getSizeY() % 8, 0u);
    int obstacles = 0;
    for (unsigned y = 0; y < grid.getSizeY(); ++y) {
        for (unsigned x = 0; x < grid.getSizeX(); ++x) {
            if (grid.getCell(static_cast<int>(x), static_cast<int>(y)) > 0.35f) continue;
            bool occupied = false;
            for (double z = 0.125; z < 1.5; z += 0.05) {
                const auto log_odds =
                    volume.logOdds(Eigen::Vector3d(grid.idx2x(x), grid.idx2y(y), z));
                occupied |= log_odds && *log_odds >= 0;
            }
            ASSERT_TRUE(occupied) << x << " " << y;
            ++obstacles;
        }
    }
    EXPECT_GT(obstacles, 300);
}

TEST(DenseMapper, gridFindsWallsWhereTheyAre) {
    const Mapped& map = exactMap();
    mrpt::maps::COccupancyGridMap2D grid;
    map.mapper.grid(grid);
    int hit = 0, rows = 0;
    for (float y = -1.8f; y < 1.8f; y += 0.05f, ++rows) {
        hit += std::min(grid.getPos(-3.02f, y), grid.getPos(-2.98f, y)) < 0.35f;
        EXPECT_GT(grid.getPos(-2.9f, y), 0.35f) << y;
    }
    EXPECT_GT(hit, 0.95 * rows);
}

/** A person who stands in the way in a few views and is gone in most. */
TEST(DenseMapper, whoWalkedByIsLeftOut) {
    BoxRoom with_person;
    const Box person{{0.2, -0.3, 0}, {0.5, 0.0, 1.7}, {0, 255, 255}};
    const BoxRoom empty;
    with_person.furniture.push_back(person);
    const SE3 T = lookingAlong({-2, 0, 1.2}, 0, 0.2);
    DenseMapper mapper(MapOptions(), smallCamera());
    for (int i = 0; i < 12; ++i)
        mapper.insert(T, render(i < 2 ? with_person : empty, smallCamera(), T));
    for (const MapPoint& point : mapper.points()) {
        ASSERT_FALSE(person.holds(point.position.cast<double>(), -0.03) &&
                     point.position.z() > 0.1f);
    }
}

TEST(DenseMapper, readingsBeyondTheRangeMakeFreeSpaceOnly) {
    MapOptions options;
    options.max_range_m = 2;
    const SE3 T = lookingAlong({-2.5, -1.5, 1.2}, 0, 0);
    DenseMapper mapper(options, smallCamera());
    mapper.insert(T, render(BoxRoom(), smallCamera(), T));
    const auto before = mapper.volume().logOdds(Eigen::Vector3d(-1, -1.5, 1.2));
    EXPECT_TRUE(before && *before < 0);
    EXPECT_FALSE(mapper.volume().logOdds(Eigen::Vector3d(2, -1.5, 1.2)));
    for (const MapPoint& point : mapper.points()) ASSERT_LT(point.position.x(), -2.5 + 2.01);
}

TEST(DenseMapper, flyingPixelsBetweenForegroundAndBackgroundAreDropped) {
    RgbdImage image;
    image.depth_unit_m = 0.001;
    image.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(3000));
    image.depth.colRange(0, 160) = 1000;
    image.depth.col(160) = 2000;  // between the two
    const cv::Mat1f clean = cleanDepth(image, smallCamera(), MapOptions());
    EXPECT_EQ(clean(120, 160), 0);
    EXPECT_NEAR(clean(120, 100), 1, 1e-6);
    EXPECT_NEAR(clean(120, 200), 3, 1e-6);
}

TEST(DenseMapper, nothingIsNotANumber) {
    const Mapped& map = noisyMap();
    for (const MapPoint& point : map.mapper.points()) ASSERT_TRUE(point.position.allFinite());
    DenseMapper mapper(MapOptions(), smallCamera());
    SE3 broken;
    broken.t.x() = std::nan("");
    const RgbdImage image = render(BoxRoom(), smallCamera(), SE3());
    EXPECT_THAT(problemOf([&] { mapper.insert(broken, image); }), testing::HasSubstr("not finite"));
}

TEST(DenseMapper, emptyDepthLeavesEmptyMaps) {
    RgbdImage image;
    image.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(0));
    DenseMapper mapper(MapOptions(), smallCamera());
    mapper.insert(SE3(), image);
    EXPECT_TRUE(mapper.points().empty());
    EXPECT_EQ(mapper.octree()->size(), 0u);
    mrpt::maps::COccupancyGridMap2D grid;
    mapper.grid(grid);
    EXPECT_EQ(grid.getSizeX() * grid.getSizeY(), 1u);
    EXPECT_NEAR(grid.getCell(0, 0), 0.5f, 0.01f);
}

TEST(DenseMapper, imageOfAnotherSizeIsRefused) {
    RgbdImage image;
    image.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(1000));
    DenseMapper mapper(MapOptions(), smallCamera());
    EXPECT_THAT(problemOf([&] { mapper.insert(SE3(), image); }),
                testing::AllOf(testing::HasSubstr("640x480"), testing::HasSubstr("320x240")));
}

/** Inserts views until the memory is refused. \return what is said \param[out] inserted views */
std::string refusalOf(const MapOptions& options, std::size_t& inserted) {
    DenseMapper mapper(options, smallCamera());
    Trajectory keyframes;
    for (const SE3& T : walk(24)) keyframes.push_back({0.1 * keyframes.size(), T});
    ViewCoverage coverage(smallCamera(), keyframes);
    inserted = 0;
    return problemOf([&] {
        for (const auto& keyframe : keyframes) {
            const SE3& T = keyframe.T_world_cam;
            mapper.insert(T, render(BoxRoom(), smallCamera(), T));
            ++inserted;
            coverage.add(T);
            mapper.checkMemory(coverage.share());
        }
    });
}

TEST(DenseMapper, tooLargeAMapIsRefusedEarlyWithTheResolutionThatFits) {
    MapOptions options;
    options.octree_resolution_m = options.grid_resolution_m = 0.005;
    options.point_voxel_m = 0.05;
    options.memory_limit_mb = 200;
    std::size_t inserted = 0;
    const std::string problem = refusalOf(options, inserted);
    EXPECT_THAT(problem, testing::AllOf(testing::HasSubstr("200"),
                                        testing::HasSubstr("octree_resolution_m to"),
                                        testing::Not(testing::HasSubstr("point_voxel_m"))));
    EXPECT_LE(inserted, 6u);
    const double advised = std::strtod(problem.c_str() + problem.find(" to ") + 4, nullptr);
    EXPECT_GT(advised, 0.005);
    EXPECT_LT(advised, 0.05);
    options.octree_resolution_m = options.grid_resolution_m = advised;
    EXPECT_EQ(refusalOf(options, inserted), "");
    EXPECT_EQ(inserted, 24u);
}

TEST(ViewCoverage, growsToAllAndNotWithRepetition) {
    Trajectory keyframes;
    for (const SE3& T : walk(24)) keyframes.push_back({0.1 * keyframes.size(), T});
    ViewCoverage coverage(smallCamera(), keyframes);
    EXPECT_EQ(coverage.share(), 0);
    for (int i = 0; i < 20; ++i) coverage.add(keyframes[0].T_world_cam);
    EXPECT_GT(coverage.share(), 0.02);
    EXPECT_LT(coverage.share(), 0.5);
    for (const auto& keyframe : keyframes) coverage.add(keyframe.T_world_cam);
    EXPECT_EQ(coverage.share(), 1);
}

TEST(DenseMapper, poseOutOfReachOfAnOctreeIsRefused) {
    DenseMapper mapper(MapOptions(), smallCamera());
    const RgbdImage image = render(BoxRoom(), smallCamera(), SE3());
    EXPECT_THAT(problemOf([&] {
                    mapper.insert(SE3(Eigen::Matrix3d::Identity(), {2000, 0, 0}), image);
                }),
                testing::HasSubstr("out of reach"));
    EXPECT_EQ(problemOf([&] {
                  mapper.insert(SE3(Eigen::Matrix3d::Identity(), {1500, 0, 0}), image);
              }),
              "");
}

TEST(DenseMapper, isTheSameEachRun) {
    const PointMap points_a = noisyMap().mapper.points(), points_b = Mapped(true).mapper.points();
    ASSERT_EQ(points_a.size(), points_b.size());
    for (std::size_t i = 0; i < points_a.size(); ++i)
        ASSERT_EQ(points_a[i].position, points_b[i].position);
}

}  // namespace
}  // namespace rgbd_graphslam
