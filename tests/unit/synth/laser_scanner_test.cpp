/** The laser scanner of planar robots. */
#include "rgbd_graphslam/synth/laser_scanner.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam::synth {
namespace {

/** A room of 6 x 4 m with a low step of 0.2 m, and a robot that stands in its middle looking along
 *  +x. */
struct Room {
    Room() {
        constexpr double tile_m = 1;
        scene.addMaterial(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(128)), tile_m);
        addBox(scene, scene.quads, standing(3, 2, 0, 0), {6, 4, 2.5}, BoxSkin(Skin{0}));
        addBox(scene, scene.quads, standing(4, 2, 0, 0), {0.5, 0.5, 0.2}, BoxSkin(Skin{0}));
        world.motion.T_world_base = [](double) {
            return SE3(Eigen::Matrix3d::Identity(), {2.8, 2, 0});
        };
    }

    std::vector<double> scan(const ScannerModel& model, std::uint64_t index = 0) const {
        return LaserScanner(world, scene, model, 1).scan(0, index);
    }

    Scene scene;
    World world;
};

ScannerModel exact() {
    ScannerModel model;
    model.noise_m = 0;
    return model;
}

TEST(LaserScanner, measuresWallsAndSeesOverLowThings) {
    const auto ranges = Room().scan(exact());
    ASSERT_EQ(ranges.size(), 1081u);
    EXPECT_NEAR(ranges[540], 3, 1e-9);                             // ahead, from x = 3
    EXPECT_NEAR(ranges[540 + 360], 2, 1e-9);                       // left
    EXPECT_NEAR(ranges[540 - 360], 2, 1e-9);                       // right
    EXPECT_NEAR(ranges[540 + 120], 3 / std::cos(M_PI / 6), 1e-9);  // the wall ahead, at 30 degrees
}

TEST(LaserScanner, noiseIsThatOfTheModelAndRepeatable) {
    const Room room;
    const auto truth = room.scan(exact()), noisy = room.scan({}), again = room.scan({}),
               other = room.scan({}, 1);
    double squares = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) squares += std::pow(noisy[i] - truth[i], 2);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(truth.size())), 0.01, 0.001);
    EXPECT_EQ(noisy, again);
    EXPECT_NE(noisy, other);
}

TEST(LaserScanner, glassIsSeenWhereBeamsMeetItSteeply) {
    Room room;
    Quad pane;
    pane.uv.fill(Eigen::Vector2d::Zero());
    pane.corners = {Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(4, 4, 0), Eigen::Vector3d(4, 4, 2),
                    Eigen::Vector3d(4, 0, 2)};
    room.world.panes = {pane};
    const auto ranges = room.scan(exact());
    EXPECT_NEAR(ranges[540], 1, 1e-9);
    EXPECT_NEAR(ranges[540 + 4 * 40], 1 / std::cos(40 * M_PI / 180), 1e-9);
    EXPECT_GT(ranges[540 + 4 * 50], 2);  // through it
}

TEST(LaserScanner, moversAreMetWhereTheyAre) {
    Room room;
    MovingBody crate;
    addBox(room.scene, crate.quads, SE3(), {0.4, 0.4, 1}, BoxSkin(Skin{0}));
    room.scene.figures = {crate};
    room.world.movers = {{"crate", [](double t) { return standing(4 + t, 2, 0, 0); }, {}}};
    const LaserScanner scanner(room.world, room.scene, exact(), 1);
    EXPECT_NEAR(scanner.scan(0, 0)[540], 0.8, 1e-9);
    EXPECT_NEAR(scanner.scan(1, 1)[540], 1.8, 1e-9);
}

TEST(LaserScanner, nothingInRangeIsNone) {
    Room room;
    room.scene.quads.clear();
    for (const double range : room.scan({})) EXPECT_EQ(range, 0);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
