#include "places.h"

#include <cmath>

#include "rgbd_graphslam/synth/furniture.h"

namespace rgbd_graphslam::synth {

namespace {
const double kPi = std::acos(-1.0);

/** Half the thickness of a wall: things hang at its face. */
constexpr double kFace = 0.061;

// Frames at a wall's face, looking into a room; `along` is x for south and north, y for the others.
SE3 onSouth(const Floor& room, double along, double z = 0) {
    return standing(along, room.min_y + kFace, z, kPi / 2);
}
SE3 onNorth(const Floor& room, double along, double z = 0) {
    return standing(along, room.max_y - kFace, z, -kPi / 2);
}
SE3 onWest(const Floor& room, double along, double z = 0) {
    return standing(room.min_x + kFace, along, z, 0);
}
SE3 onEast(const Floor& room, double along, double z = 0) {
    return standing(room.max_x - kFace, along, z, kPi);
}
SE3 before(const SE3& at_wall, double distance) {
    return at_wall * SE3(Eigen::Matrix3d::Identity(), {distance, 0, 0});
}

void closedRoom(Furnisher& furnish, const Floor& room, Furnisher::Covering covering, int style) {
    furnish.floorAndCeiling(room, covering);
    const Eigen::Vector2d a(room.min_x, room.min_y), b(room.max_x, room.min_y),
        c(room.max_x, room.max_y), d(room.min_x, room.max_y);
    const double h = room.height;
    furnish.wall(a, b, h, furnish.plaster(style));
    furnish.wall(b, c, h, furnish.plaster(style + 1));
    furnish.wall(c, d, h, furnish.plaster(style));
    furnish.wall(d, a, h, furnish.plaster(style));
}
}  // namespace

Scene officeRoom(std::uint64_t seed) {
    Scene scene;
    Furnisher furnish(scene, seed);
    const Floor room{0, 6.4, 0, 5.2, 2.7};
    closedRoom(furnish, room, Furnisher::Covering::Parquet, 0);
    furnish.ceilingLamp(1.8, 2.6, room.height, 0.55);
    furnish.ceilingLamp(4.6, 2.6, room.height, 0.55);

    furnish.workplace(before(onSouth(room, 1.5), 0.45), 1.7);
    furnish.workplace(before(onSouth(room, 4.4), 0.45), 1.6);
    furnish.wallClutter(onSouth(room, 1.6, 0.15), 2.6);
    furnish.wallClutter(onSouth(room, 4.7, 0.15), 2.4);
    furnish.shelf(onSouth(room, 2.95), 0.8, 1.9, 5);

    furnish.shelf(onEast(room, 1.1), 1.0, 2.0, 5);
    furnish.shelf(onEast(room, 2.15), 1.0, 2.0, 5);
    furnish.whiteboard(onEast(room, 3.7, 0.95));
    furnish.cabinet(onEast(room, 3.7), 1.3, 0.75);
    furnish.plant(before(onEast(room, 4.75), 0.35), 1.3);

    furnish.window(onNorth(room, 1.7, 0.95), 1.7, 1.3, 0.8);
    furnish.radiator(onNorth(room, 1.7), 1.4);
    furnish.workplace(before(onNorth(room, 4.4), 0.45), 1.6);
    furnish.art(onNorth(room, 3.1, 1.3), 0.7, 0.55);
    furnish.window(onNorth(room, 4.5, 1.25), 1.5, 1.0, 0.7);
    furnish.poster(onNorth(room, 5.75, 1.2), 0.55, 0.8);

    furnish.door(onWest(room, 0.75));
    furnish.clock(onWest(room, 1.6, 2.05));
    furnish.sofa(onWest(room, 2.9), 1.7);
    furnish.art(onWest(room, 2.4, 1.3), 0.8, 0.6);
    furnish.poster(onWest(room, 3.35, 1.15), 0.6, 0.85);
    furnish.cabinet(onWest(room, 4.35), 0.9, 1.1);
    furnish.floorLamp(standing(0.45, 1.75, 0, 0));

    furnish.table(standing(3.1, 2.6, 0, 0.15), {0.8, 1.3, 0.72});
    furnish.clutter(standing(3.1, 2.6, 0.72, 0.15), 0.6, 1.1, 6);
    furnish.papers(standing(3.2, 2.5, 0.72, 0.4), 4);
    furnish.rug(standing(3.1, 2.6, 0, 0.05), 2.6, 1.9);
    furnish.chair(standing(3.8, 2.9, 0, 2.9));
    furnish.bin(standing(2.35, 0.35, 0, 0));
    furnish.cardboardPile(standing(5.95, 0.35, 0, 0.3), 3);
    furnish.cardboardPile(standing(0.5, 4.95, 0, 0.3), 1);
    return scene;
}

}  // namespace rgbd_graphslam::synth
