#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../../support/tum_folder.h"
#include "../mapping/box_room.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/navigation/clearance.h"
#include "rgbd_graphslam/navigation/drive_job.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;
using mrpt::math::TPose2D;
using testing::HasSubstr;

const RobotBody square{{0, 0.5, {{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}}};

void addBox(PlyModel& model, const Box& box) {
    const auto first = static_cast<std::uint32_t>(model.vertices.size());
    for (unsigned k = 0; k < 8; ++k) {
        model.vertices.emplace_back(static_cast<float>((k & 1 ? box.high : box.low).x()),
                                    static_cast<float>((k & 2 ? box.high : box.low).y()),
                                    static_cast<float>((k & 4 ? box.high : box.low).z()));
    }
    for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 3, 7, 6},
                                     {0, 2, 6, 4},
                                     {1, 3, 7, 5}}) {
        model.triangles.push_back({first + a, first + b, first + c});
        model.triangles.push_back({first + a, first + c, first + d});
    }
}

PlyModel surfaceOf(const BoxRoom& room) {
    PlyModel surface;
    addBox(surface, room.walls);
    for (const Box& box : room.furniture) addBox(surface, box);
    return surface;
}

/** The output folder of a run through the box room whose poses are known, with its truth. */
class Drive : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TestFolder;
        const BoxRoom room;
        Noise noise;
        DenseMapper mapper({}, smallCamera());
        Trajectory trajectory;
        for (const SE3& T : walk(24)) {
            trajectory.push_back({1000 + 0.1 * static_cast<double>(trajectory.size()), T});
            mapper.insert(T, render(room, smallCamera(), T, 0, &noise));
        }
        mrpt::maps::COccupancyGridMap2D grid;
        mapper.grid(grid);
        saveMrptObject(path("grid.gridmap.gz"), grid);
        savePly(path("points.ply"), mapper.points());
        writeTextAtomically(path("trajectory.txt"), toTumText(trajectory));
        writePly(path("surface.ply"), surfaceOf(room));
    }
    static void TearDownTestSuite() { delete folder_; }

    static std::string path(const std::string& name) { return *folder_ / name; }

    static DriveRequest request() {
        DriveRequest request;
        request.ini = RGBD_SOURCE_DIR "/ini/drive.ini";
        request.run_folder = *folder_ / "";
        request.start = TPose2D(-1.2, -1.4, 0);
        request.goal = {1.6, 1.3};  // on the other side of the table and past the cupboard
        request.surface = path("surface.ply");
        request.truth = path("trajectory.txt");
        return request;
    }

    static std::string problemOf(const DriveRequest& request) {
        try {
            runDrive(request);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

  private:
    static inline TestFolder* folder_ = nullptr;
};

TEST_F(Drive, arrivesAtTheGoalWithoutTouchingTheTrueSurface) {
    const DriveSummary summary = runDrive(request());
    EXPECT_TRUE(summary.arrived) << summary.why_not;
    EXPECT_GT(summary.driven_m, std::hypot(2.8, 2.7) - 0.3);
    ASSERT_TRUE(summary.least_clearance_m);
    EXPECT_GT(*summary.least_clearance_m, 0.02);
    std::ifstream csv(path("path.csv"));
    std::string line, last;
    while (std::getline(csv, line)) last = line;
    double time, x, y;
    ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf", &time, &x, &y), 3);
    EXPECT_LT(std::hypot(x - 1.6, y - 1.3), 0.3);
    EXPECT_TRUE(std::filesystem::exists(path("drive.png")));
}

TEST_F(Drive, isTheSameEachTime) {
    auto shorter = request();
    shorter.goal = {0.3, -1.2};
    runDrive(shorter);
    const std::string first = readText(path("path.csv"));
    runDrive(shorter);
    EXPECT_EQ(readText(path("path.csv")), first);
}

TEST_F(Drive, followsTheRouteOfTheGridAsWell) {
    auto along_route = request();
    along_route.settings = {"DriveOptions.follow=route"};
    EXPECT_TRUE(runDrive(along_route).good());
}

TEST_F(Drive, refusesStartsAndGoalsThatAreNotFreeAndNamesOneThatIs) {
    auto in_table = request();
    in_table.goal = {1.6, 0};
    EXPECT_THAT(problemOf(in_table), HasSubstr("the goal 1.60,0.00 is not free"));
    EXPECT_THAT(problemOf(in_table), HasSubstr("the nearest place that is: "));
    auto outside = request();
    outside.start = TPose2D(50, 50, 0);
    EXPECT_THAT(problemOf(outside), HasSubstr("the start 50.00,50.00 is not free"));
}

TEST_F(Drive, saysWhatIsMissing) {
    auto elsewhere = request();
    elsewhere.run_folder = path("nowhere");
    EXPECT_THAT(problemOf(elsewhere), HasSubstr("grid.gridmap.gz' is missing"));
    auto half_truth = request();
    half_truth.truth.clear();
    EXPECT_THAT(problemOf(half_truth), HasSubstr("--surface and --truth belong together"));
    auto no_body = request();
    no_body.ini = path("empty.ini");
    writeTextAtomically(no_body.ini, "[DriveOptions]\nleg_m = 2\n");
    EXPECT_THAT(problemOf(no_body), HasSubstr("HEIGHT_LEVELS is missing"));
}

TEST_F(Drive, refusesADamagedGrid) {
    const TestFolder broken;
    writeTextAtomically(broken / "grid.gridmap.gz", "no grid");
    auto damaged = request();
    damaged.run_folder = broken / "";
    EXPECT_THAT(problemOf(damaged), HasSubstr("grid.gridmap.gz' is cut off or no grid map"));
}

TEST(Clearance, isTheDistanceFromTheBodysOutline) {
    EXPECT_NEAR(signedDistance(square[0].outline, {0.5, 0}), 0.3, 1e-12);
    EXPECT_NEAR(signedDistance(square[0].outline, {0.3, 0.3}), std::hypot(0.1, 0.1), 1e-12);
    EXPECT_NEAR(signedDistance(square[0].outline, {0.15, 0}), -0.05, 1e-12);
}

TEST(Clearance, turnsWithTheRobotAndLooksAtItsHeightsOnly) {
    PlyModel posts;
    posts.vertices = {{1, 0, 0.3f}, {0, 0.05f, 0.7f}, {0, 0, 0.01f}};
    const TrueObstacles obstacles(posts, square, 0.03);
    EXPECT_NEAR(obstacles.clearance({0, 0, 0}), 0.8, 1e-6);
    EXPECT_NEAR(obstacles.clearance({0, 0, M_PI / 4}), 1 - 0.2 * std::sqrt(2), 1e-6);
    EXPECT_LT(obstacles.clearance({0.9, 0, 0}), 0);
}

TEST(Clearance, posesAreBroughtToTheFloorOfATiltedMapsTruth) {
    const SE3 T_truth_map(rotationExp({0.02, 0, 0}) * rotationExp({0, 0, M_PI / 2}), {5, 1, 0});
    const TPose2D pose = inTruth(T_truth_map, {2, 0, 0});
    EXPECT_NEAR(pose.x, 5, 1e-9);
    EXPECT_NEAR(pose.y, 1 + 2 * std::cos(0.02), 1e-9);
    EXPECT_NEAR(pose.phi, M_PI / 2, 1e-9);
}

}  // namespace
}  // namespace rgbd_graphslam
