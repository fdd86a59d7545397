#include "rgbd_graphslam/synth/furniture.h"

#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

const double kPi = std::acos(-1.0);

SE3 shifted(const SE3& frame, double x, double y, double z) {
    return frame * SE3(Eigen::Matrix3d::Identity(), {x, y, z});
}
SE3 turned(const SE3& frame, double yaw_rad) {
    return frame * SE3(rotationExp({0, 0, yaw_rad}), Vector3d::Zero());
}
}  // namespace

void Furnisher::box(const SE3& frame, const Vector3d& size, const BoxSkin& skin) {
    addBox(scene_, scene_.quads, frame, size, skin);
}

void Furnisher::cylinder(const SE3& frame, double radius, double top_radius, double height,
                         const Skin& side, const Skin& cap) {
    addCylinder(scene_.quads, frame, radius, top_radius, height, side, cap);
}

void Furnisher::panel(const SE3& frame, double width, double height, double depth,
                      const Skin& front) {
    box(shifted(frame, depth / 2, 0, 0), {depth, width, height}, BoxSkin(front, Skin{metals_[1]}));
}

// ---- the building --------------------------------------------------------------------------

void Furnisher::floorAndCeiling(const Floor& floor, Covering covering) {
    const double width = floor.max_x - floor.min_x, length = floor.max_y - floor.min_y;
    const SE3 middle =
        standing((floor.min_x + floor.max_x) / 2, (floor.min_y + floor.max_y) / 2, 0, 0);
    const Skin ground{floors_[static_cast<int>(covering)]};
    {
        const Labeling as(scene_.quads, Label::Floor);
        box(shifted(middle, 0, 0, -0.1), {width, length, 0.1}, BoxSkin(ground));
    }
    const Labeling as(scene_.quads, Label::Ceiling);
    box(shifted(middle, 0, 0, floor.height), {width, length, 0.1}, BoxSkin(Skin{ceiling_}));
}

void Furnisher::wall(const Vector2d& from, const Vector2d& to, double height, int paint,
                     const std::vector<Opening>& openings) {
    const Labeling as(scene_.quads, Label::Wall);
    const double thickness = 0.12, length = (to - from).norm();
    const double yaw = std::atan2(to.y() - from.y(), to.x() - from.x()) - kPi / 2;
    const SE3 start = standing(from.x(), from.y(), 0, yaw);  // +y runs along the wall
    const auto piece = [&](double begin, double end, double bottom, double top, double depth,
                           int material) {
        if (end - begin > 1e-6 && top - bottom > 1e-6)
            box(shifted(start, 0, (begin + end) / 2, bottom), {depth, end - begin, top - bottom},
                BoxSkin(Skin{material}));
    };
    const auto solid = [&](double begin, double end) {
        piece(begin, end, 0, height, thickness, paint);
        piece(begin, end, 0, 0.08, thickness + 0.025, woods_[1]);
    };
    double at = -thickness / 2;
    for (const Opening& gap : openings) {
        const double begin = gap.along_m - gap.width_m / 2, end = gap.along_m + gap.width_m / 2;
        solid(at, begin);
        piece(begin, end, gap.height_m, height, thickness, paint);
        piece(begin - 0.04, begin + 0.04, 0, gap.height_m, thickness + 0.05, woods_[2]);
        piece(end - 0.04, end + 0.04, 0, gap.height_m, thickness + 0.05, woods_[2]);
        piece(begin - 0.04, end + 0.04, gap.height_m, gap.height_m + 0.08, thickness + 0.05,
              woods_[2]);
        at = end;
    }
    solid(at, length + thickness / 2);
}

void Furnisher::ceilingLamp(double x, double y, double ceiling_z, double intensity) {
    const Labeling as(scene_.quads, Label::Lamp);
    box(standing(x, y, ceiling_z - 0.05, 0), {0.35, 1.2, 0.05}, BoxSkin(Skin{lamp_}));
    scene_.lamps.push_back({{x, y, ceiling_z - 0.25}, intensity, {0.94, 1.0, 1.0}});
}

// ---- on a wall -----------------------------------------------------------------------------

void Furnisher::poster(const SE3& frame, double width, double height) {
    const Labeling as(scene_.quads, Label::Picture);
    panel(frame, width, height, 0.015, anyOf(posters_));
}

void Furnisher::art(const SE3& frame, double width, double height) {
    const Labeling as(scene_.quads, Label::Picture);
    panel(frame, width, height, 0.035, anyOf(arts_));
}

void Furnisher::whiteboard(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Picture);
    panel(frame, 1.5, 0.95, 0.025, Skin{whiteboard_});
    box(shifted(frame, 0.05, 0, -0.03), {0.08, 1.2, 0.02}, BoxSkin(Skin{metals_[0]}));
    for (int i = 0; i < 4; ++i)
        box(shifted(frame, 0.05, -0.4 + 0.22 * i, -0.01), {0.025, 0.12, 0.02},
            BoxSkin(anyOf(packages_)));
}

void Furnisher::window(const SE3& frame, double width, double height, double intensity) {
    const Labeling as(scene_.quads, Label::Window);
    panel(frame, width, height, 0.04, anyOf(windows_));
    box(shifted(frame, 0.1, 0, -0.04), {0.2, width + 0.1, 0.04}, BoxSkin(Skin{white_}));
    if (random_.chance(0.7)) plant(shifted(frame, 0.1, width * 0.3, 0), 0.35);
    scene_.lamps.push_back({frame * Vector3d(0.35, 0, height * 0.6), intensity, {1.1, 1.02, 0.95}});
}

void Furnisher::door(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Door);
    panel(frame, 0.92, 2.05, 0.05, anyOf(doors_));
    for (double side : {-0.5, 0.5})
        box(shifted(frame, 0.04, side, 0), {0.08, 0.08, 2.1}, BoxSkin(Skin{woods_[2]}));
    box(shifted(frame, 0.04, 0, 2.05), {0.08, 1.08, 0.08}, BoxSkin(Skin{woods_[2]}));
}

void Furnisher::clock(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Picture);
    panel(frame, 0.3, 0.3, 0.04, Skin{clock_});
}

void Furnisher::radiator(const SE3& frame, double width) {
    const Labeling as(scene_.quads, Label::Radiator);
    const int ribs = static_cast<int>(width / 0.08);
    for (int i = 0; i < ribs; ++i)
        box(shifted(frame, 0.08, -width / 2 + 0.08 * (i + 0.5), 0.12), {0.1, 0.055, 0.6},
            BoxSkin(Skin{white_}));
    box(shifted(frame, 0.08, 0, 0.72), {0.12, width, 0.03}, BoxSkin(Skin{white_}));
}

void Furnisher::wallClutter(const SE3& frame, double width) {
    const Labeling as(scene_.quads, Label::Picture);
    for (double y = -width / 2; y < width / 2 - 0.5;) {
        const double size = random_.uniform(0.35, 0.75), tall = size * random_.uniform(0.8, 1.45);
        const double z = random_.uniform(1.0, 1.3);
        const SE3 place = shifted(frame, 0, y + size / 2, z);
        if (random_.chance(0.65))
            poster(place, size, tall);
        else
            art(place, size, size * 0.75);
        if (random_.chance(0.35))
            panel(shifted(place, 0, size / 2 + 0.16, 0.1), 0.21, 0.297, 0.008, anyOf(papers_));
        y += size + random_.uniform(0.25, 0.9);
    }
}

// ---- on the floor --------------------------------------------------------------------------

void Furnisher::table(const SE3& frame, const Vector3d& size) {
    const Labeling as(scene_.quads, Label::Table);
    const Skin wood = anyOf(woods_), metal = anyOf(metals_);
    box(shifted(frame, 0, 0, size.z() - 0.035), {size.x(), size.y(), 0.035}, BoxSkin(wood));
    for (double x : {-0.5, 0.5})
        for (double y : {-0.5, 0.5})
            box(shifted(frame, x * (size.x() - 0.12), y * (size.y() - 0.12), 0),
                {0.05, 0.05, size.z() - 0.035}, BoxSkin(metal));
}

void Furnisher::workplace(const SE3& frame, double width, bool chair_too) {
    const Labeling as(scene_.quads, Label::Table);
    const double height = 0.74, depth = 0.8;
    table(frame, {depth, width, height});
    box(shifted(frame, -0.05, width / 2 - 0.3, 0), {0.6, 0.42, 0.62}, BoxSkin(anyOf(woods_)));
    const SE3 top = shifted(frame, 0, 0, height);
    const double screen_yaw = random_.uniform(-.15, .15);
    monitor(turned(shifted(top, -0.2, random_.uniform(-0.1, 0.1), 0), screen_yaw));
    if (width > 1.5) monitor(turned(shifted(top, -0.18, -0.62, 0), 0.4));
    const BoxSkin keys(Skin{black_});
    BoxSkin keyboard = keys;
    keyboard.top = Skin{keyboard_};
    box(turned(shifted(top, 0.18, 0, 0), random_.uniform(-0.1, 0.1)), {0.15, 0.45, 0.022},
        keyboard);
    box(shifted(top, 0.2, 0.33, 0), {0.1, 0.06, 0.03}, keys);
    papers(shifted(top, 0.15, -width / 2 + 0.3, 0), 3);
    cup(shifted(top, 0.02, 0.42, 0));
    bookPile(shifted(top, -0.15, width / 2 - 0.2, 0), 3 + random_.below(4));
    clutter(shifted(top, -0.05, -width / 2 + 0.25, 0), 0.5, 0.4, 4);
    if (!chair_too) return;
    const double chair_yaw = kPi + random_.uniform(-0.5, 0.5);
    chair(turned(shifted(frame, 0.75, random_.uniform(-0.15, 0.15), 0), chair_yaw));
}

void Furnisher::chair(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Chair);
    const Skin fabric = anyOf(fabrics_), metal{metals_[1]};
    box(shifted(frame, 0, 0, 0.43), {0.46, 0.46, 0.07}, BoxSkin(fabric));
    box(shifted(frame, -0.22, 0, 0.58), {0.06, 0.44, 0.42}, BoxSkin(fabric));
    for (double x : {-0.2, 0.2})
        for (double y : {-0.2, 0.2})
            box(shifted(frame, x, y, 0), {0.035, 0.035, 0.43}, BoxSkin(metal));
    for (double y : {-0.16, 0.16})
        box(shifted(frame, -0.22, y, 0.5), {0.03, 0.03, 0.08}, BoxSkin(metal));
}

void Furnisher::bookRow(const SE3& frame, double width, double headroom) {
    const Labeling as(scene_.quads, Label::Object);
    double y = -width / 2;
    while (y < width / 2 - 0.06) {
        if (random_.chance(0.06)) {
            y += random_.uniform(0.05, 0.2);
            continue;
        }
        const double thick = random_.uniform(0.018, 0.055);
        const double tall = std::min(headroom - 0.02, random_.uniform(0.17, 0.3));
        const double deep = random_.uniform(0.15, 0.23);
        BoxSkin cover(spine());
        cover.back = cover.bottom = kHidden;
        box(shifted(frame, deep / 2 + random_.uniform(0.02, 0.05), y + thick / 2, 0),
            {deep, thick, tall}, cover);
        y += thick + 0.002;
    }
}

void Furnisher::packageRow(const SE3& frame, double width, double headroom) {
    const Labeling as(scene_.quads, Label::Object);
    for (double y = -width / 2 + 0.12; y < width / 2 - 0.1; y += random_.uniform(0.2, 0.34)) {
        const double side = random_.uniform(0.1, 0.19);
        const double tall = std::min(headroom - 0.02, random_.uniform(0.1, 0.26));
        const SE3 place = turned(shifted(frame, 0.15, y, 0), random_.uniform(-0.4, 0.4));
        if (random_.chance(0.25)) {
            const Skin lid = anyOf(metals_);
            cylinder(place, side / 2, side / 2, tall, anyOf(packages_), lid);
        } else {
            box(place, {side, side, tall},
                BoxSkin(anyOf(random_.chance(0.5) ? packages_ : boxes_)));
        }
    }
}

void Furnisher::shelf(const SE3& frame, double width, double height, int boards) {
    const Labeling as(scene_.quads, Label::Shelf);
    const double depth = 0.3, plank = 0.025;
    const Skin wood = anyOf(woods_);
    for (double side : {-0.5, 0.5})
        box(shifted(frame, depth / 2, side * (width - plank), 0), {depth, plank, height},
            BoxSkin(wood));
    box(shifted(frame, 0.006, 0, 0), {0.012, width - 2 * plank, height}, BoxSkin(wood));
    const double pitch = (height - plank) / boards;
    for (int i = 0; i <= boards; ++i)
        box(shifted(frame, depth / 2, 0, pitch * i), {depth, width - 2 * plank, plank},
            BoxSkin(wood));
    for (int i = 0; i < boards; ++i) {
        const SE3 level = shifted(frame, 0.02, 0, pitch * i + plank);
        if (random_.chance(0.7))
            bookRow(level, width - 2 * plank - 0.02, pitch - plank);
        else
            packageRow(level, width - 2 * plank, pitch - plank);
    }
    clutter(shifted(frame, depth / 2, 0, height), depth - 0.05, width - 0.1, 4);
}

void Furnisher::cabinet(const SE3& frame, double width, double height) {
    const Labeling as(scene_.quads, Label::Cabinet);
    const Skin wood = anyOf(woods_);
    const int doors = std::max(1, static_cast<int>(std::lround(width / 0.5)));
    box(shifted(frame, 0.2, 0, 0), {0.4, width, height}, BoxSkin(wood));
    for (int i = 0; i < doors; ++i) {
        const double y = -width / 2 + width * (i + 0.5) / doors;
        box(shifted(frame, 0.41, y, 0.06), {0.02, width / doors - 0.02, height - 0.09},
            BoxSkin(anyOf(woods_)));
        box(shifted(frame, 0.435, y + width / doors / 2 - 0.07, height * 0.45), {0.025, 0.02, 0.12},
            BoxSkin(Skin{metals_[0]}));
    }
    clutter(shifted(frame, 0.2, 0, height), 0.32, width - 0.1, static_cast<int>(5 * width));
}

void Furnisher::sofa(const SE3& frame, double width) {
    const Labeling as(scene_.quads, Label::Sofa);
    const Skin fabric = anyOf(fabrics_), other = anyOf(fabrics_);
    box(shifted(frame, 0.42, 0, 0.08), {0.84, width, 0.32}, BoxSkin(fabric));
    box(shifted(frame, 0.12, 0, 0.4), {0.24, width, 0.42}, BoxSkin(fabric));
    for (double side : {-0.5, 0.5})
        box(shifted(frame, 0.42, side * (width - 0.2), 0.4), {0.84, 0.2, 0.2}, BoxSkin(fabric));
    for (double side : {-0.25, 0.25})
        box(turned(shifted(frame, 0.34, side * width, 0.4), 0.3), {0.14, 0.4, 0.36},
            BoxSkin(other));
}

void Furnisher::plant(const SE3& frame, double height) {
    const Labeling as(scene_.quads, Label::Plant);
    const double pot = height * 0.3;
    cylinder(frame, pot * 0.35, pot * 0.48, pot, anyOf(packages_), Skin{leaves_});
    for (int i = 0; i < 22; ++i) {
        const double yaw = 2 * kPi * random_.uniform(), tilt = random_.uniform(0.1, 1.1);
        const double size = height * random_.uniform(0.14, 0.3);
        const SE3 leaf = turned(shifted(frame, 0, 0, pot + height * random_.uniform(0, 0.4)), yaw) *
                         SE3(rotationExp({0, tilt, 0}), Vector3d::Zero());
        const double u = 0.5 * random_.uniform(), v = 0.5 * random_.uniform();
        addRectangle(scene_, scene_.quads, shifted(leaf, 0, -size / 3, 0), size * 0.66, size * 1.6,
                     {leaves_, {u, v}, {u + 0.3, v + 0.5}});
    }
}

void Furnisher::floorLamp(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Lamp);
    cylinder(frame, 0.15, 0.15, 0.03, Skin{metals_[1]}, Skin{metals_[1]});
    cylinder(frame, 0.015, 0.015, 1.5, Skin{metals_[1]}, Skin{metals_[1]});
    cylinder(shifted(frame, 0, 0, 1.45), 0.2, 0.13, 0.25, Skin{lamp_}, Skin{lamp_});
    scene_.lamps.push_back({frame * Vector3d(0, 0, 1.35), 0.25, {0.7, 0.9, 1.1}});
}

void Furnisher::bin(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Bin);
    cylinder(frame, 0.11, 0.14, 0.32, anyOf(metals_), Skin{black_});
}

void Furnisher::rug(const SE3& frame, double length, double width) {
    const Labeling as(scene_.quads, Label::Rug);
    BoxSkin skin(Skin{woods_[1]});
    skin.top = anyOf(rugs_);
    box(frame, {length, width, 0.012}, skin);
}

void Furnisher::cardboardPile(const SE3& frame, int count) {
    const Labeling as(scene_.quads, Label::Box);
    double z = 0;
    for (int i = 0; i < count; ++i) {
        const double side = random_.uniform(0.3, 0.48), tall = random_.uniform(0.22, 0.36);
        const Skin skin = anyOf(boxes_);
        const double yaw = random_.uniform(-0.4, 0.4);
        const double y = random_.uniform(-.03, .03), x = random_.uniform(-.03, .03);
        box(turned(shifted(frame, x, y, z), yaw), {side, side * 1.2, tall}, BoxSkin(skin));
        z += tall;
    }
}

// ---- on a table ----------------------------------------------------------------------------

void Furnisher::monitor(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Screen);
    box(frame, {0.18, 0.24, 0.015}, BoxSkin(Skin{black_}));
    box(shifted(frame, -0.03, 0, 0), {0.03, 0.06, 0.2}, BoxSkin(Skin{black_}));
    box(shifted(frame, 0, 0, 0.11), {0.035, 0.54, 0.34}, BoxSkin(anyOf(screens_), Skin{black_}));
}

void Furnisher::cup(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Object);
    cylinder(frame, 0.036, 0.042, 0.095, anyOf(packages_), Skin{black_});
}

void Furnisher::bookPile(const SE3& frame, int count) {
    const Labeling as(scene_.quads, Label::Object);
    double z = 0;
    for (int i = 0; i < count; ++i) {
        const double thick = random_.uniform(0.018, 0.045);
        BoxSkin skin(spine());
        skin.top = anyOf(packages_);
        const Vector3d size{random_.uniform(0.14, 0.19), random_.uniform(0.2, 0.26), thick};
        box(turned(shifted(frame, 0, 0, z), random_.uniform(-0.5, 0.5)), size, skin);
        z += thick;
    }
}

void Furnisher::papers(const SE3& frame, int count) {
    const Labeling as(scene_.quads, Label::Object);
    for (int i = 0; i < count; ++i) {
        BoxSkin skin(Skin{white_});
        skin.bottom = kHidden;
        skin.top = anyOf(papers_);
        const double yaw = random_.uniform(-0.7, 0.7);
        const double y = random_.uniform(-0.12, 0.12), x = random_.uniform(-0.1, 0.1);
        box(turned(shifted(frame, x, y, 0.004 * i), yaw), {0.297, 0.21, 0.004}, skin);
    }
}

void Furnisher::package(const SE3& frame) {
    const Labeling as(scene_.quads, Label::Object);
    const double side = random_.uniform(0.06, 0.15);
    const Skin skin = anyOf(packages_);
    box(frame, {side, side * random_.uniform(0.7, 1.4), random_.uniform(0.05, 0.22)},
        BoxSkin(skin));
}

void Furnisher::clutter(const SE3& frame, double length, double width, int count) {
    for (int i = 0; i < count; ++i) {
        const double y = width * ((i + random_.uniform(0.2, 0.8)) / count - 0.5);
        const double yaw = random_.uniform(-0.8, 0.8);
        const SE3 place = turned(shifted(frame, length * random_.uniform(-0.3, 0.3), y, 0), yaw);
        switch (random_.below(5)) {
            case 0:
                cup(place);
                break;
            case 1:
                bookPile(place, 1 + random_.below(4));
                break;
            case 2:
                plant(place, 0.3);
                break;
            default:
                package(place);
        }
    }
}

// ---- people --------------------------------------------------------------------------------

MovingBody Furnisher::trunk(const Skin& shirt) {
    MovingBody figure;
    addBox(scene_, figure.quads, standing(0, 0, 0.88, 0), {0.24, 0.42, 0.58}, BoxSkin(shirt));
    addCylinder(figure.quads, standing(0, 0, 1.44, 0), 0.06, 0.06, 0.08, Skin{face_}, Skin{face_});
    addCylinder(figure.quads, standing(0, 0, 1.5, -0.6), 0.085, 0.1, 0.25, Skin{face_},
                Skin{face_, {0.4, 0}, {0.6, 0.2}});
    label(figure.quads, Label::Person);
    return figure;
}

MovingBody Furnisher::limb(double length, double thickness, const Skin& cloth, bool with_shoe) {
    MovingBody figure;
    addBox(scene_, figure.quads, standing(0, 0, -length, 0), {thickness, thickness, length},
           BoxSkin(cloth));
    if (with_shoe)
        addBox(scene_, figure.quads, standing(0.05, 0, -length, 0), {0.26, 0.1, 0.08},
               BoxSkin(Skin{black_}));
    label(figure.quads, Label::Person);
    return figure;
}

void Furnisher::person() {
    const Skin shirt = anyOf(clothes_), trousers = anyOf(fabrics_);
    scene_.figures.push_back(trunk(shirt));
    for (int leg = 0; leg < 2; ++leg) scene_.figures.push_back(limb(0.88, 0.15, trousers, true));
    for (int arm = 0; arm < 2; ++arm) scene_.figures.push_back(limb(0.65, 0.1, shirt, false));
}

}  // namespace rgbd_graphslam::synth
