#include "places.h"

#include <cmath>

#include "rgbd_graphslam/synth/furniture.h"
#include "rgbd_graphslam/synth/textures.h"

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

void ring(Furnisher& furnish, const Floor& outline, int style) {
    const Eigen::Vector2d a(outline.min_x, outline.min_y), b(outline.max_x, outline.min_y),
        c(outline.max_x, outline.max_y), d(outline.min_x, outline.max_y);
    furnish.wall(a, b, outline.height, furnish.plaster(style));
    furnish.wall(b, c, outline.height, furnish.plaster(style + 1));
    furnish.wall(c, d, outline.height, furnish.plaster(style));
    furnish.wall(d, a, outline.height, furnish.plaster(style));
}

void closedRoom(Furnisher& furnish, const Floor& room, Furnisher::Covering covering, int style) {
    furnish.floorAndCeiling(room, covering);
    ring(furnish, room, style);
}

// ---- the office ----------------------------------------------------------------------------

void officeSouth(Furnisher& furnish, const Floor& room, bool chair_at_desk) {
    furnish.workplace(before(onSouth(room, 1.5), 0.45), 1.7, chair_at_desk);
    furnish.workplace(before(onSouth(room, 4.4), 0.45), 1.6);
    furnish.wallClutter(onSouth(room, 1.6, 0.15), 2.6);
    furnish.wallClutter(onSouth(room, 4.7, 0.15), 2.4);
    furnish.shelf(onSouth(room, 2.95), 0.8, 1.9, 5);
    furnish.bin(standing(2.35, 0.35, 0, 0));
    furnish.cardboardPile(standing(5.95, 0.35, 0, 0.3), 3);
}

void officeEast(Furnisher& furnish, const Floor& room) {
    furnish.shelf(onEast(room, 1.1), 1.0, 2.0, 5);
    furnish.shelf(onEast(room, 2.15), 1.0, 2.0, 5);
    furnish.whiteboard(onEast(room, 3.7, 0.95));
    furnish.cabinet(onEast(room, 3.7), 1.3, 0.75);
    furnish.plant(before(onEast(room, 4.75), 0.35), 1.3);
}

void officeNorth(Furnisher& furnish, const Floor& room) {
    furnish.window(onNorth(room, 1.7, 0.95), 1.7, 1.3, 0.8);
    furnish.radiator(onNorth(room, 1.7), 1.4);
    furnish.workplace(before(onNorth(room, 4.4), 0.45), 1.6);
    furnish.art(onNorth(room, 3.1, 1.3), 0.7, 0.55);
    furnish.window(onNorth(room, 4.5, 1.25), 1.5, 1.0, 0.7);
    furnish.poster(onNorth(room, 5.75, 1.2), 0.55, 0.8);
    furnish.cardboardPile(standing(0.5, 4.95, 0, 0.3), 1);
}

void officeWest(Furnisher& furnish, const Floor& room) {
    furnish.door(onWest(room, 0.75));
    furnish.clock(onWest(room, 1.6, 2.05));
    furnish.sofa(onWest(room, 2.9), 1.7);
    furnish.art(onWest(room, 2.4, 1.3), 0.8, 0.6);
    furnish.poster(onWest(room, 3.35, 1.15), 0.6, 0.85);
    furnish.cabinet(onWest(room, 4.35), 0.9, 1.1);
    furnish.floorLamp(standing(0.45, 1.75, 0, 0));
}

void officeMiddle(Furnisher& furnish) {
    furnish.table(standing(3.1, 2.6, 0, 0.15), {0.8, 1.3, 0.72});
    furnish.clutter(standing(3.1, 2.6, 0.72, 0.15), 0.6, 1.1, 6);
    furnish.papers(standing(3.2, 2.5, 0.72, 0.4), 4);
    furnish.rug(standing(3.1, 2.6, 0, 0.05), 2.6, 1.9);
    furnish.chair(standing(3.8, 2.9, 0, 2.9));
}

// ---- the apartment -------------------------------------------------------------------------

void furnishLiving(Furnisher& furnish, const Floor& room) {
    furnish.sofa(before(onWest(room, 2.5), -0.06), 1.5);
    furnish.wallClutter(onWest(room, 2.5, 0.1), 3.8);
    furnish.shelf(onSouth(room, 3.3), 1.1, 2.0, 5);
    furnish.door(onSouth(room, 1.0));
    furnish.poster(onSouth(room, 2.2, 1.1), 0.6, 0.9);
    furnish.window(onNorth(room, 1.5, 0.9), 1.6, 1.3, 0.7);
    furnish.radiator(onNorth(room, 1.5), 1.3);
    furnish.shelf(onNorth(room, 3.4), 0.9, 1.8, 4);
    furnish.art(onEast(room, 2.5, 1.3), 0.9, 0.65);
    furnish.cabinet(onEast(room, 2.5), 1.2, 0.8);
    furnish.table(standing(2.6, 2.5, 0, 0), {1.2, 0.7, 0.45});
    furnish.clutter(standing(2.6, 2.5, 0.45, 0), 1.0, 0.6, 4);
    furnish.papers(standing(2.9, 2.4, 0.45, 0.3), 3);
    furnish.rug(standing(2.4, 2.5, 0, 0), 2.3, 1.6);
    furnish.plant(before(onWest(room, 4.6), 0.3), 1.2);
}

void furnishStudy(Furnisher& furnish, const Floor& room) {
    furnish.workplace(before(onEast(room, 2.5), 0.42), 1.6, false);
    furnish.wallClutter(onEast(room, 2.5, 0.2), 4.2);
    furnish.whiteboard(onSouth(room, 7.0, 0.95));
    furnish.shelf(onSouth(room, 8.7), 1.0, 1.9, 5);
    furnish.wallClutter(onNorth(room, 6.8, 0.0), 2.6);
    furnish.window(onNorth(room, 8.8, 1.0), 1.3, 1.2, 0.7);
    furnish.cabinet(onNorth(room, 7.0), 1.2, 0.7);
    furnish.shelf(onWest(room, 2.5), 1.3, 1.7, 4);
    furnish.table(standing(7.4, 2.5, 0, 0.1), {1.3, 0.8, 0.74});
    furnish.bookPile(standing(7.2, 2.4, 0.74, 0.2), 7);
    furnish.clutter(standing(7.5, 2.5, 0.74, 0), 1.1, 0.7, 5);
    furnish.cardboardPile(standing(6.4, 2.6, 0, 0.5), 2);
    furnish.bin(standing(9.7, 0.4, 0, 0));
}

// ---- the storey ----------------------------------------------------------------------------

void furnishCorridor(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Tiles);
    for (double x : {2.0, 6.0, 10.0, 14.0, 18.0, 22.0})
        furnish.ceilingLamp(x, 1.1, room.height, 0.4);
    for (double x : {4.3, 8.4, 12.6, 16.8}) {
        furnish.door(onSouth(room, x));
        furnish.wallClutter(onSouth(room, x + 2.05, 0), 2.6);
    }
    furnish.wallClutter(onSouth(room, 1.9, 0.1), 2.6);
    furnish.wallClutter(onSouth(room, 21.6, 0.1), 3.4);
    for (double x : {6.0, 10.5, 15.0}) {
        furnish.door(onNorth(room, x));
        furnish.wallClutter(onNorth(room, x + 2.2, 0.05), 2.6);
    }
    furnish.poster(onNorth(room, 4.3, 0.9), 0.8, 1.1);
    furnish.radiator(onNorth(room, 13.2), 1.2);
    furnish.cardboardPile(before(onSouth(room, 6.0), 0.2), 2);
    furnish.bin(before(onNorth(room, 9.3), 0.2));
    furnish.plant(before(onSouth(room, 14.0), 0.25), 1.0);
    furnish.plant(before(onEast(room, 0.5), 0.3), 1.2);
    furnish.cabinet(onEast(room, 1.35), 0.9, 0.8);
    furnish.poster(onEast(room, 1.3, 1.1), 0.7, 1.0);
    furnish.art(onWest(room, 1.1, 1.0), 1.0, 0.75);
}

void furnishLounge(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Carpet);
    furnish.ceilingLamp(2.2, 4.2, room.height, 0.5);
    furnish.ceilingLamp(2.2, 7.8, room.height, 0.5);
    furnish.window(onWest(room, 4.0, 0.9), 1.6, 1.3, 0.7);
    furnish.window(onWest(room, 7.8, 0.9), 1.6, 1.3, 0.7);
    furnish.sofa(onEast(room, 5.0), 1.8);
    furnish.wallClutter(onEast(room, 6.0, 0.1), 6.6);
    furnish.sofa(onWest(room, 6.0), 1.4);
    furnish.shelf(onEast(room, 8.4), 1.2, 1.1, 3);
    furnish.plant(before(onWest(room, 9.4), 0.35), 1.3);
    furnish.floorLamp(before(onEast(room, 6.6), 0.4));
    furnish.rug(standing(2.2, 5.6, 0, kPi / 2), 2.6, 1.8);
    furnish.cabinet(onWest(room, 2.9), 0.9, 0.8);
}

void furnishCopyRoom(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Tiles);
    furnish.ceilingLamp(21.6, 4.2, room.height, 0.5);
    furnish.ceilingLamp(21.6, 7.8, room.height, 0.5);
    furnish.shelf(onWest(room, 3.6), 1.4, 2.0, 5);
    furnish.cabinet(onWest(room, 5.4), 1.6, 0.9);
    furnish.wallClutter(onWest(room, 5.6, 0.15), 1.9);
    furnish.whiteboard(onWest(room, 7.6, 0.95));
    furnish.cardboardPile(before(onWest(room, 8.9), 0.35), 4);
    furnish.cardboardPile(before(onWest(room, 6.9), 0.3), 2);
    furnish.table(before(onEast(room, 4.6), 0.4), {0.7, 1.8, 0.8});
    furnish.clutter(before(onEast(room, 4.6), 0.4) * standing(0, 0, 0.8, 0), 0.5, 1.6, 8);
    furnish.wallClutter(onEast(room, 5.6, 0.1), 5.6);
    furnish.shelf(onEast(room, 7.6), 1.6, 1.0, 3);
    furnish.bin(before(onEast(room, 6.0), 0.25));
}

void furnishBigStudy(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Parquet);
    furnish.ceilingLamp(2.2, 12.5, room.height, 0.5);
    furnish.ceilingLamp(5.8, 12.5, room.height, 0.5);
    furnish.workplace(before(onNorth(room, 2.2), 0.45), 1.7);
    furnish.workplace(before(onNorth(room, 5.6), 0.45), 1.6);
    furnish.window(onNorth(room, 3.9, 1.1), 1.2, 1.1, 0.6);
    furnish.wallClutter(onNorth(room, 2.0, 0.3), 2.2);
    furnish.wallClutter(onNorth(room, 6.3, 0.3), 2.4);
    furnish.shelf(onSouth(room, 4.6), 1.3, 1.9, 5);
    furnish.cabinet(onSouth(room, 6.6), 1.4, 0.9);
    furnish.wallClutter(onSouth(room, 6.6, 0.2), 2.2);
    furnish.wallClutter(onWest(room, 12.5, 0.1), 4.2);
    furnish.cabinet(onWest(room, 14.1), 1.2, 0.8);
}

void furnishLibrary(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Carpet);
    furnish.ceilingLamp(10, 12.5, room.height, 0.5);
    furnish.ceilingLamp(14, 12.5, room.height, 0.5);
    for (double x : {9.0, 10.3, 13.6, 15.0}) furnish.shelf(onNorth(room, x), 1.2, 2.0, 5);
    for (double x : {9.2, 11.9, 14.6}) furnish.shelf(onSouth(room, x), 1.3, 1.9, 5);
    furnish.window(onNorth(room, 12.0, 0.9), 1.4, 1.3, 0.7);
    furnish.art(onSouth(room, 10.6, 1.1), 0.9, 0.7);
    furnish.poster(onSouth(room, 13.2, 1.0), 0.8, 1.1);
    furnish.chair(standing(11.9, 14.2, 0, -1.2));
    furnish.cardboardPile(before(onSouth(room, 10.6), 0.3), 1);
}

void furnishMeetingRoom(Furnisher& furnish, const Floor& room) {
    furnish.floorAndCeiling(room, Furnisher::Covering::Carpet);
    furnish.ceilingLamp(18, 12.5, room.height, 0.5);
    furnish.ceilingLamp(22, 12.5, room.height, 0.5);
    furnish.table(standing(18.6, 14.2, 0, kPi / 2), {0.9, 2.4, 0.74});
    furnish.clutter(standing(18.6, 14.2, 0.74, kPi / 2), 0.7, 2.2, 8);
    furnish.papers(standing(18.2, 14.1, 0.74, 0.2), 4);
    furnish.chair(standing(17.9, 13.5, 0, 1.5));
    furnish.chair(standing(19.3, 13.5, 0, 1.7));
    furnish.whiteboard(onNorth(room, 18.4, 1.1));
    furnish.window(onNorth(room, 21.6, 0.9), 1.6, 1.3, 0.7);
    furnish.radiator(onNorth(room, 21.6), 1.3);
    furnish.wallClutter(onSouth(room, 18.4, 0.1), 4.2);
    furnish.shelf(onSouth(room, 18.4), 1.5, 1.0, 3);
    furnish.wallClutter(onEast(room, 12.5, 0.1), 4.4);
    furnish.cabinet(onEast(room, 13.9), 1.3, 0.8);
    furnish.sofa(onEast(room, 11.2), 1.3);
}
}  // namespace

Scene officeRoom(Office layout, std::uint64_t seed) {
    Scene scene;
    Furnisher furnish(scene, seed);
    const Floor room{0, 6.4, 0, 5.2, 2.7};
    closedRoom(furnish, room, Furnisher::Covering::Parquet, 0);
    furnish.ceilingLamp(1.8, 2.6, room.height, 0.55);
    furnish.ceilingLamp(4.6, 2.6, room.height, 0.55);
    officeSouth(furnish, room, layout != Office::DeskFree);
    officeEast(furnish, room);
    officeNorth(furnish, room);
    officeWest(furnish, room);
    if (layout != Office::OpenMiddle) officeMiddle(furnish);
    if (layout == Office::DeskFree) {
        furnish.clutter(standing(1.15, 0.62, 0.74, 0), 0.3, 0.5, 4);
        furnish.papers(standing(1.9, 0.7, 0.74, 1), 3);
        furnish.package(standing(2.15, 0.4, 0.74, 0.5));
    }
    return scene;
}

Scene apartment(std::uint64_t seed) {
    Scene scene;
    Furnisher furnish(scene, seed, 2);
    const Floor living{0, 5, 0, 5, 2.6}, study{5, 10, 0, 5, 2.6};
    furnish.floorAndCeiling(living, Furnisher::Covering::Parquet);
    furnish.floorAndCeiling(study, Furnisher::Covering::Carpet);
    ring(furnish, {0, 10, 0, 5, 2.6}, 0);
    furnish.wall({5, 0}, {5, 5}, 2.6, furnish.plaster(2), {{1, 1.2, 2.1}, {4, 1.2, 2.1}});
    for (double x : {1.6, 3.8, 6.4, 8.6}) furnish.ceilingLamp(x, 2.5, 2.6, 0.45);
    furnishLiving(furnish, living);
    furnishStudy(furnish, study);
    return scene;
}

Scene storey(std::uint64_t seed) {
    Scene scene;
    scene.ambient = 0.6;
    Furnisher furnish(scene, seed, 4);
    const double h = 2.6;
    const Floor corridor{0, 24, 0, 2.2, h}, lounge{0, 4.4, 2.2, 10, h}, copy{19.2, 24, 2.2, 10, h},
        study{0, 8, 10, 15, h}, library{8, 16, 10, 15, h}, meeting{16, 24, 10, 15, h};
    ring(furnish, {0, 24, 0, 15, h}, 0);
    const std::vector<Opening> ends{{2.2, 1.5, 2.1}, {21.8, 1.5, 2.1}};
    furnish.wall({0, 2.2}, {24, 2.2}, h, furnish.plaster(1), ends);
    furnish.wall({0, 10}, {24, 10}, h, furnish.plaster(2), ends);
    furnish.wall({4.4, 2.2}, {4.4, 10}, h, furnish.bricks());
    furnish.wall({19.2, 2.2}, {19.2, 10}, h, furnish.plaster(3));
    for (double x : {8.0, 16.0})
        furnish.wall({x, 10}, {x, 15}, h, furnish.plaster(x > 10 ? 0 : 3), {{2.5, 1.5, 2.1}});
    furnishCorridor(furnish, corridor);
    furnishLounge(furnish, lounge);
    furnishCopyRoom(furnish, copy);
    furnishBigStudy(furnish, study);
    furnishLibrary(furnish, library);
    furnishMeetingRoom(furnish, meeting);
    return scene;
}

Scene plainRoom(std::uint64_t seed) {
    Scene scene;
    Random random = Random::of(seed, 6);
    const int white = scene.addMaterial(paintPlaster(Bgr(200, 208, 212), 1.5, random), 2.5);
    const int gray = scene.addMaterial(paintPlaster(Bgr(150, 155, 158), 1.5, random), 2.5);
    const auto block = [&](double x, double y, double yaw, const Eigen::Vector3d& size, int paint,
                           double z = 0) {
        addBox(scene, scene.quads, standing(x, y, z, yaw), size, BoxSkin(Skin{paint}));
    };
    block(3, 2.5, 0, {6, 5, 0.1}, gray, -0.1);
    label(scene.quads, Label::Floor);
    block(3, 2.5, 0, {6, 5, 0.1}, white, 2.6);
    label(scene.quads, Label::Ceiling);
    for (double y : {-0.05, 5.05}) block(3, y, 0, {6, 0.1, 2.6}, white);
    for (double x : {-0.05, 6.05}) block(x, 2.5, 0, {0.1, 5, 2.6}, white);
    label(scene.quads, Label::Wall);
    block(0.3, 0.3, 0, {0.6, 0.6, 2.6}, white);
    block(5.5, 4.3, 0, {0.5, 0.5, 2.6}, white);
    for (int step = 0; step < 4; ++step)
        block(5.7 - 0.3 * step, 1.0, 0, {0.3, 1.4, 0.8 - 0.2 * step}, gray);
    block(2.4, 4.6, 0, {1.4, 0.8, 0.75}, white);
    block(2.1, 4.7, 0.5, {0.4, 0.3, 0.35}, gray, 0.75);
    block(0.5, 2.9, 0.2, {0.6, 0.9, 1.1}, white);
    block(3.6, 0.35, 0, {1.2, 0.5, 1.5}, white);
    block(3.4, 0.3, 0.4, {0.35, 0.3, 0.4}, gray, 1.5);
    label(scene.quads, Label::Pillar);
    for (const SE3& frame : {standing(0.01, 1.4, 1.1, 0), standing(1.6, 0.01, 1.3, kPi / 2),
                             standing(5.99, 3.2, 1.2, kPi), standing(4.0, 4.99, 1.2, -kPi / 2)})
        addRectangle(scene, scene.quads, frame, 0.3, 0.42, {scene.addMaterial(paintPaper(random))});
    label(scene.quads, Label::Picture);
    scene.lamps = {{{1.6, 2.6, 2.4}, 0.5, {1, 1, 1}}, {{4.6, 1.8, 2.4}, 0.35, {0.9, 1, 1.05}}};
    return scene;
}

Scene paintedWall(std::uint64_t seed) {
    Scene scene;
    Random random = Random::of(seed, 7);
    const double width = 0.75, height = 1.0;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 16; ++column) {
            const int picture =
                scene.addMaterial(random.chance(0.6) ? paintPoster(random) : paintArt(random));
            addRectangle(scene, scene.quads, standing(0, width * (column - 8), height * row, 0),
                         width, height, {picture});
        }
    label(scene.quads, Label::Picture);
    scene.lamps = {{{2.5, -2, 3.4}, 1, {1, 1, 1}}, {{2.5, 3, 3.0}, 0.8, {0.9, 1, 1.1}}};
    return scene;
}

Scene officeWithPeople(int people, std::uint64_t seed) {
    Scene scene = officeRoom(Office::OpenMiddle, seed);
    Furnisher furnish(scene, seed + 1);
    for (int i = 0; i < people; ++i) furnish.person();
    return scene;
}

}  // namespace rgbd_graphslam::synth
