/** SLAM on scans of made floor plans. */
#include "rgbd_graphslam/laser/laser_slam.h"

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include "../../support/floor_plan.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/laser/scan_grid.h"

namespace rgbd_graphslam {
namespace {

struct Drive {
    std::vector<PlanarPose> truth, odometry;
    std::vector<PlanarScan> scans;
};

Drive drive(const FloorPlan& plan, const std::vector<Eigen::Vector2d>& corners, int seed,
            double scale = 1.03, double yaw_scale = 1.04) {
    RandomInputs random(seed);
    Drive made;
    made.truth = driveAlong(corners);
    made.odometry = odometryOf(made.truth, scale, yaw_scale, random);
    for (std::size_t i = 0; i < made.truth.size(); ++i) {
        const double stamp_s = 0.1 * static_cast<double>(i);
        made.scans.push_back(toPlanarScan(*scanOf(plan, made.truth[i], stamp_s, random), 0.1, 20));
    }
    return made;
}

void run(const Drive& drive, LaserSlam& slam, bool with_odometry = true) {
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        slam.add(drive.scans[i],
                 with_odometry ? std::optional<PlanarPose>(drive.odometry[i]) : std::nullopt);
    }
    slam.finish();
}

/** Largest distance to the truth, both beginning at the same pose. */
double worstError(const LaserSlam& slam, const Drive& drive) {
    double worst = 0;
    for (std::size_t i = 0; i < drive.truth.size(); ++i) {
        const PlanarPose expected = drive.truth.front().inverse() * drive.truth[i];
        worst = std::max(worst,
                         (positionOf(slam.poseOf(slam.scans()[i])) - positionOf(expected)).norm());
    }
    return worst;
}

std::size_t loopsOf(const LaserSlam& slam) {
    std::size_t loops = 0;
    for (const PoseEdge& edge : slam.edges()) loops += edge.kind == EdgeKind::Loop;
    return loops;
}

TEST(LaserSlam, closesARingOfCorridors) {
    for (const int seed : {1, 2, 3}) {
        const Drive made = drive(ringOfCorridors(), roundsInRing(1), seed);
        LaserSlam slam({});
        run(made, slam);
        EXPECT_LT(worstError(slam, made), 0.08) << "seed " << seed;
        EXPECT_GT(loopsOf(slam), 0u);
        for (const TrackedScan& scan : slam.scans()) EXPECT_TRUE(scan.matched);
    }
}

TEST(LaserSlam, goesWithoutOdometryWhereScansTellTheWay) {
    FloorPlan room;
    room.addBox(0, 0, 7, 5);
    room.addBox(3, 2, 3.8, 2.6);
    room.addBox(0, 3.5, 1, 5);
    const Drive made = drive(room, {{1, 1}, {6, 1}, {6, 4}, {2, 4}, {1.5, 1}, {6, 1}}, 4);
    LaserSlam slam({});
    run(made, slam, false);
    EXPECT_LT(worstError(slam, made), 0.05);
}

TEST(LaserSlam, givesTheSameTwice) {
    const Drive made = drive(ringOfCorridors(), {{1, 1}, {12, 1}}, 5);
    LaserSlam a({}), b({});
    run(made, a);
    run(made, b);
    for (std::size_t i = 0; i < a.scans().size(); ++i) {
        EXPECT_EQ(a.poseOf(a.scans()[i]).x, b.poseOf(b.scans()[i]).x);
        EXPECT_EQ(a.poseOf(a.scans()[i]).yaw, b.poseOf(b.scans()[i]).yaw);
    }
}

/** Two rooms that look the same, side by side along a corridor. */
TEST(LaserSlam, doesNotJoinRoomsThatLookAlike) {
    FloorPlan plan;
    plan.addBox(0, 0, 40, 2);
    plan.walls.erase(plan.walls.begin() + 2);  // wall to the rooms
    for (const double x : {4., 14., 24.}) {
        for (const Wall& wall :
             {Wall{{x, 2}, {x, 6}}, Wall{{x, 6}, {x + 5, 6}}, Wall{{x + 5, 6}, {x + 5, 2}},
              Wall{{x, 2}, {x + 2, 2}}, Wall{{x + 3, 2}, {x + 5, 2}}, Wall{{x + 5, 2}, {x + 9, 2}},
              Wall{{x + 1, 5}, {x + 2, 5}}}) {
            plan.walls.push_back(wall);
        }
    }
    plan.walls.push_back({{0, 2}, {4, 2}});
    plan.walls.push_back({{33, 2}, {40, 2}});
    const Drive made = drive(plan,
                             {{1, 1},
                              {6.5, 1},
                              {6.5, 4},
                              {6.5, 1},
                              {16.5, 1},
                              {16.5, 4},
                              {16.5, 1},
                              {26.5, 1},
                              {26.5, 4},
                              {26.5, 1},
                              {38, 1}},
                             6, 1.02, 1.02);
    LaserSlam slam({});
    run(made, slam);
    EXPECT_LT(worstError(slam, made), 0.8);  // a wrong loop would be off by ten meters
}

TEST(LaserSlam, scansWithoutReadingsAreDeadReckoned) {
    Drive made = drive(ringOfCorridors(), {{1, 1}, {8, 1}}, 7, 1, 1);
    for (std::size_t i = 40; i < 60; ++i) made.scans[i].points.clear();
    LaserSlam slam({});
    run(made, slam);
    EXPECT_TRUE(slam.scans()[39].matched);
    EXPECT_FALSE(slam.scans()[50].matched);
    EXPECT_TRUE(slam.scans()[70].matched);
    EXPECT_LT(worstError(slam, made), 0.08);
}

ScanBeams beams(const FloorPlan& plan, const Eigen::Vector2d& origin) {
    ScanBeams all;
    all.origin = origin;
    for (double angle = 0; angle < 2 * M_PI; angle += 0.01) {
        const double range = plan.range(origin, angle);
        all.ends.push_back(origin + range * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return all;
}

float cellAt(const mrpt::maps::COccupancyGridMap2D& grid, double x, double y) {
    return grid.getCell(grid.x2idx(x), grid.y2idx(y));
}

TEST(ScanGrid, wallsAreOccupiedAndRoomsFree) {
    FloorPlan room;
    room.addBox(0, 0, 4, 3);
    ScanGrid scans(0.05);
    for (int i = 0; i < 3; ++i) scans.insert(beams(room, {2, 1.5}));
    mrpt::maps::COccupancyGridMap2D grid;
    scans.build(grid, 100);
    EXPECT_GT(cellAt(grid, 1, 1), 0.7f);
    EXPECT_LT(cellAt(grid, 4.01, 1.5), 0.3f);
    EXPECT_NEAR(cellAt(grid, -0.06, -0.06), 0.5f, 0.01f);
    EXPECT_THROW(scans.build(grid, 0), Error);
}

TEST(ScanGrid, mergingKeepsWhatEitherHasSeenOccupied) {
    FloorPlan pane;
    pane.addBox(1, 1, 2, 2);
    ScanGrid scans(0.05);
    for (int i = 0; i < 3; ++i) scans.insert(beams(pane, {1.5, 1.5}));
    mrpt::maps::COccupancyGridMap2D grid;
    grid.setSize(0, 1.5, 0, 3, 0.05f, 0.95f);  // a camera looked through the pane
    grid.setCell(grid.x2idx(1.2), grid.y2idx(1.5), 0.1f);
    scans.mergeInto(grid, 100);
    EXPECT_LT(std::min(cellAt(grid, 0.98, 1.5), cellAt(grid, 1.02, 1.5)), 0.3f);  // the pane
    EXPECT_LT(cellAt(grid, 1.2, 1.5), 0.3f);  // what only the camera saw
    EXPECT_GT(cellAt(grid, 0.5, 0.5), 0.9f);
    EXPECT_GT(cellAt(grid, 1.8, 1.5), 0.6f);  // beyond the grid's first extent
}

}  // namespace
}  // namespace rgbd_graphslam
