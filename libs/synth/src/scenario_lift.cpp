/** A robot in the cabin of a lift with a glass front: half of what it sees passes by. Poses are
 *  those in the cabin, which is what wheels and gyroscope tell; the accelerometer feels the lift.
 */
#include <algorithm>
#include <cmath>

#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "rgbd_graphslam/synth/furniture.h"
#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);
const Floor kCabin{0, 2.2, 0, 1.8, 2.3};
constexpr double kShaft_x = 2.6;

double height(double t) {
    return 5 * easing(t, 1.5, 8.5);
}

SE3 raised(double height_m) {
    return {Eigen::Matrix3d::Identity(), {0, 0, height_m}};
}

Scene cabin(std::uint64_t seed) {
    Scene scene;
    Furnisher furnish(scene, seed);
    furnish.floorAndCeiling(kCabin, Furnisher::Covering::Carpet);
    furnish.ceilingLamp(1.1, 0.9, kCabin.height, 0.6);
    const double h = kCabin.height;
    furnish.wall({0, 0}, {2.2, 0}, h, furnish.plaster(0));
    furnish.wall({2.2, 1.8}, {0, 1.8}, h, furnish.plaster(1));
    furnish.wall({0, 1.8}, {0, 0}, h, furnish.plaster(2));
    furnish.wall({2.2, 0}, {2.2, 1.8}, h, furnish.plaster(1), {{0.9, 0.95, 2.25}});
    for (double y : {0.24, 1.56}) {
        furnish.poster(standing(2.13, y, 0.75, kPi), 0.34, 0.5);
        furnish.poster(standing(2.13, y, 0.1, kPi), 0.34, 0.5);
        furnish.poster(standing(2.13, y, 1.4, kPi), 0.34, 0.5);
    }
    for (double x : {0.5, 1.1, 1.75}) {
        furnish.poster(standing(x, 0.07, 0.55, kPi / 2), 0.5, 0.75);
        furnish.art(standing(x, 1.73, 0.6, -kPi / 2), 0.5, 0.6);
    }
    return scene;
}

/** The front of the house across the shaft: bricks with pictures on every floor. */
MovingBody facade(Scene& scene, Random& random) {
    MovingBody body;
    const Skin bricks{scene.addMaterial(paintBricks(random), 1.1)};
    addRectangle(scene, body.quads, standing(kShaft_x, 4, -8, kPi), 6, 14, bricks);
    for (double z = -7.5; z < 5.5; z += 0.65)
        for (double y : {0.5, 1.15}) {
            const Skin picture{scene.addMaterial(paintPoster(random))};
            addRectangle(scene, body.quads, standing(kShaft_x - 0.01, y + 0.25, z, kPi), 0.5, 0.55,
                         picture);
        }
    label(body.quads, Label::Outside);
    // Evenly, as in the middle of the glass front.
    body.lit_at.linear() = Vector3d(1, 0, 0).asDiagonal();
    body.lit_at.translation() = Vector3d(-0.7, 0.9, 1.2);
    return body;
}

/** Drives in for 3 s, then turns to and fro. */
SE3 driven(double t) {
    const double along = 0.45 * easing(t, 0.3, 3),
                 turn = 0.45 * std::sin(0.9 * std::max(0.0, t - 3));
    return standing(0.35 + along, 0.9, 0, turn * easing(t, 3, 4));
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = cabin(seed);
        Random random = Random::of(seed, 27);
        scene.figures = {facade(scene, random)};
        return scene;
    };
    world.movers = {{"outside", [](double t) { return raised(-height(t)); }, raised(0)}};
    world.motion.duration_s = 10;
    world.motion.T_world_base = driven;
    world.motion.T_world_cam = [](double t) { return driven(t) * robotCamera(); };
    world.motion.T_inertial_world = [](double t) { return raised(height(t)); };
    world.exposure = drifting;
    return world;
}
}  // namespace

Scenario lift() {
    return {"lift", "planar robot in a glass lift that goes up five meters", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
