#include "rgbd_graphslam/evaluation/grid_accuracy.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** A wall 2 m high in the plane x = 1, y in [0, 1], and a floor. */
PlyModel wall() {
    PlyModel model;
    model.vertices = {{1, 0, 0}, {1, 1, 0}, {1, 1, 2}, {1, 0, 2}, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
    model.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
    return model;
}

TEST(GridAccuracy, countsCellsWithoutAnObstacleNear) {
    const auto accuracy = evaluateGrid({{1.05, 0.5, 0}, {1.2, 0.5, 0}, {0.3, 0.3, 0}}, wall());
    EXPECT_EQ(accuracy.occupied, 3u);
    EXPECT_EQ(accuracy.wrong, 2u);
    EXPECT_FALSE(accuracy.on_movers_ways);
}

TEST(GridAccuracy, tellsWhichOfThemLieOnAWayMovedByTheAlignment) {
    MoverBox box;
    box.speed_m_s = 1;
    box.T_world_box.t = {2, 2, 1};
    box.size_m = {0.3, 0.3, 0.5};
    const MoverWays ways({box});
    GridAccuracyOptions options;
    options.movers = &ways;
    options.alignment.motion.t = {1, 0, 0.3};
    const auto accuracy =
        evaluateGrid({{1.1, 2.1, 0}, {1.5, 2.1, 0}, {0, 0.5, 0}}, wall(), options);
    EXPECT_EQ(accuracy.wrong, 2u);
    EXPECT_EQ(accuracy.on_movers_ways.value(), 1u);
}

TEST(GridAccuracy, needsAnObstacle) {
    GridAccuracyOptions options;
    options.min_z_m = 3;
    options.max_z_m = 4;
    EXPECT_THROW(evaluateGrid({{0, 0, 0}}, wall(), options), Error);
}

TEST(OccupiedCells, areTheBlackOnesWithTheLowestRowLast) {
    const std::string folder = std::string(RGBD_BINARY_DIR) + "/grid_accuracy_test";
    std::filesystem::create_directories(folder);
    cv::Mat image(3, 4, CV_8UC1, cv::Scalar(254));
    image.at<uchar>(2, 1) = 0;
    image.at<uchar>(0, 0) = 205;
    cv::imwrite(folder + "/grid.png", image);
    std::ofstream(folder + "/grid.yaml")
        << "image: grid.png\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n";
    const auto cells = occupiedCells(folder + "/grid.yaml");
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0], Eigen::Vector3d(-0.25, 2.25, 0));
    std::filesystem::remove(folder + "/grid.png");
    EXPECT_THROW(occupiedCells(folder + "/grid.yaml"), Error);
    EXPECT_THROW(occupiedCells(folder + "/none.yaml"), Error);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rgbd_graphslam
