/** A pane that the camera looks through and a laser scanner sees is an obstacle in the grid. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include "../support/run_program.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

TEST(GlassCorridor, paneIsAnObstacle) {
    const TestFolder folder;
    const auto run = [&](const std::string& program, const std::string& arguments) {
        const ProgramResult result = runProgram(program, arguments);
        ASSERT_EQ(result.exit_code, 0) << result.err;
    };
    run("rgbd-synth",
        "glass-corridor '" + folder / "film" + "' --frames 60 --every 2 --size 320x240 --scanner");
    run("rgbd-import", "'" + folder / "film" + "' '" + folder / "film.rawlog" + "'");
    run("rgbd-slam", "'" + folder / "film.rawlog" + "' -o '" + folder / "out" + "'");
    EXPECT_THAT(readText(folder / "out/summary.json"), testing::HasSubstr("CObservation2DRange"));
    const auto grid = loadGridMap(folder / "out/grid.gridmap.gz");
    // The run's world is where the camera begins, turned: the first true pose tells how.
    const StampedPose first = readTumTrajectory(folder / "out/trajectory.txt").front();
    const SE3 T_world_cam =
        *poseAt(readTumTrajectory(folder / "film/groundtruth.txt"), first.stamp_s);
    const SE3 T_run_world = first.T_world_cam * T_world_cam.inverse();
    int occupied = 0, columns = 0;
    for (double y = 0.6; y < 1.6; y += 0.05, ++columns) {
        bool found = false;
        for (double x = 19.9; x <= 20.1; x += 0.025) {
            const Eigen::Vector3d p = T_run_world * Eigen::Vector3d(x, y, 0.25);
            found |= grid.getCell(grid.x2idx(p.x()), grid.y2idx(p.y())) < 0.35f;
        }
        occupied += found;
    }
    EXPECT_GT(occupied, 0.9 * columns);
}

}  // namespace
}  // namespace rgbd_graphslam
