#include "rgbd_graphslam/mapping/view_scale.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/mapping/height_colors.h"

namespace rgbd_graphslam {
namespace {

TEST(RoundLength, isTheLargestOfOneTwoAndFive) {
    EXPECT_DOUBLE_EQ(roundLength(1), 1);
    EXPECT_DOUBLE_EQ(roundLength(1.99), 1);
    EXPECT_DOUBLE_EQ(roundLength(4.9), 2);
    EXPECT_DOUBLE_EQ(roundLength(0.07), 0.05);
    EXPECT_DOUBLE_EQ(roundLength(1000), 1000);
}

TEST(LengthText, hasTheUnitPeopleUse) {
    EXPECT_EQ(lengthText(0.2), "20 cm");
    EXPECT_EQ(lengthText(1.5), "1.5 m");
    EXPECT_EQ(lengthText(2000), "2 km");
    EXPECT_EQ(lengthText(-0.4), "-40 cm");
    EXPECT_EQ(lengthText(-1e-12), "0 m");
}

TEST(ScaleBar, isOfARoundLengthAndNoLongerThanAskedFor) {
    for (const double m_per_px : {0.0007, 0.003, 0.02, 1.3}) {
        const ScaleBar bar = scaleBar(m_per_px, 150);
        EXPECT_LE(bar.length_px, 150);
        EXPECT_GT(bar.length_px, 55);
        EXPECT_DOUBLE_EQ(bar.length_px * m_per_px, bar.length_m);
    }
}

TEST(FloorGrid, coversTheBoxInADozenRoundSteps) {
    const FloorGrid room = floorGrid({Eigen::Vector3d(-3.3, -2, 0), Eigen::Vector3d(4.4, 3, 2)});
    EXPECT_DOUBLE_EQ(room.step_m, 1);
    EXPECT_DOUBLE_EQ(room.x_min_m, -4);
    EXPECT_DOUBLE_EQ(room.y_max_m, 3);
    const FloorGrid desk = floorGrid({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1.9, 1, 1)});
    EXPECT_DOUBLE_EQ(desk.step_m, 0.2);
    const FloorGrid street = floorGrid({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 390, 9)});
    EXPECT_DOUBLE_EQ(street.step_m, 50);
}

TEST(FloorLabels, keepTheirDistance) {
    const FloorGrid grid = floorGrid({Eigen::Vector3d(-6, -6, 0), Eigen::Vector3d(6, 6, 2)});
    OrbitCamera camera;
    const Eigen::Vector2i size_px(800, 600);
    for (const double distance_m : {6., 15., 60., 300.}) {
        camera.distance_m = distance_m;
        const auto labels = floorLabels(grid, camera, size_px);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GE((labels[i].pixel - labels[j].pixel).norm(), 52) << distance_m;
            EXPECT_GE(labels[i].pixel.minCoeff(), 0);
        }
        if (distance_m > 10 && distance_m < 100) {
            EXPECT_GE(labels.size(), 3U) << distance_m;
        }
    }
}

TEST(FloorLabels, stateTheDistancesInOneUnit) {
    FloorGrid grid;
    grid.x_max_m = 2, grid.y_max_m = 2, grid.step_m = 0.5;
    OrbitCamera camera;
    camera.target = {1, 1, 0};
    for (const SceneLabel& label : floorLabels(grid, camera, {1000, 800}, 10))
        EXPECT_EQ(label.text.find("cm"), std::string::npos) << label.text;
}

TEST(HeightColor, goesFromBlueToRedWithoutRepeating) {
    EXPECT_GT(heightColor(0)[2], 150);
    EXPECT_GT(heightColor(1)[0], 150);
    EXPECT_EQ(heightColor(-3), heightColor(0));
    EXPECT_EQ(heightColor(7), heightColor(1));
    const auto apart = [](const Rgba& a, const Rgba& b) {
        int sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]);
        return sum;
    };
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < i; ++j)
            EXPECT_GT(apart(heightColor(0.1 * i), heightColor(0.1 * j)), 40) << i << " " << j;
        // Against the background, all stand out.
        EXPECT_GT(apart(heightColor(0.1 * i), background_color), 100) << i;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
