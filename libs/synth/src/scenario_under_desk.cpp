/** Under a desk: dim, near, and beside a strip of polished metal whose depth is that of the strip
 *  while its picture is that of the room in front. */
#include <algorithm>
#include <cmath>

#include "deceits.h"
#include "filming.h"
#include "rgbd_graphslam/synth/furniture.h"
#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);
constexpr double kMirror_y = -0.086;  // behind the wall's face
const Floor kRoom{0, 4, kMirror_y, 3.4, 2.6};
constexpr double kStrip_x = 1.6, kStrip_width_m = 1.3, kStrip_height_m = 0.3;

void walls(Furnisher& furnish) {
    const double h = kRoom.height;
    furnish.wall({0, 0}, {4, 0}, h, furnish.plaster(0),
                 {{kStrip_x, kStrip_width_m, kStrip_height_m}});
    furnish.wall({4, 0}, {4, 3.4}, h, furnish.plaster(1));
    furnish.wall({4, 3.4}, {0, 3.4}, h, furnish.plaster(0));
    furnish.wall({0, 3.4}, {0, 0}, h, furnish.plaster(2));
}

void furniture(Furnisher& furnish) {
    furnish.workplace(standing(1.6, 0.52, 0, kPi / 2), 1.8, false);
    furnish.wallClutter(standing(1.7, 0.07, 0.2, kPi / 2), 2.8);
    furnish.poster(standing(1.35, 0.07, 0.36, kPi / 2), 0.4, 0.3);
    furnish.art(standing(1.85, 0.07, 0.36, kPi / 2), 0.4, 0.3);
    furnish.bin(standing(2.15, 0.3, 0, 0));
    furnish.cardboardPile(standing(2.75, 0.35, 0, 0.2), 2);
    furnish.bookPile(standing(1.75, 0.28, 0, 0.3), 3);
    furnish.shelf(standing(0.07, 1.4, 0, 0), 1.0, 1.8, 5);
    furnish.cabinet(standing(3.93, 1.2, 0, kPi), 1.2, 0.8);
    furnish.shelf(standing(1.2, 3.33, 0, -kPi / 2), 1.1, 1.9, 5);
    furnish.wallClutter(standing(2.8, 3.33, 0.1, -kPi / 2), 1.8);
    furnish.rug(standing(1.8, 1.6, 0, 0.1), 1.8, 1.2);
}

/** The room as it appears in the plane of the mirror. */
MovingBody reflected(const Scene& scene) {
    MovingBody image;
    image.lit_at.linear().diagonal().y() = -1;
    image.lit_at.translation().y() = 2 * kMirror_y;
    for (Quad quad : scene.quads) {
        for (Vector3d& corner : quad.corners) corner.y() = 2 * kMirror_y - corner.y();
        // The other way round, so that the front stays the front.
        std::reverse(quad.corners.begin(), quad.corners.end());
        std::reverse(quad.uv.begin(), quad.uv.end());
        image.quads.push_back(quad);
    }
    return image;
}

MovingBody strip(Scene& scene, std::uint64_t seed) {
    MovingBody pane;
    Random random = Random::of(seed, 28);
    const Skin metal{scene.addMaterial(paintMetal(Bgr::all(140), random), 0.5)};
    addRectangle(scene, pane.quads, standing(kStrip_x + kStrip_width_m / 2, kMirror_y, 0, kPi / 2),
                 kStrip_width_m, kStrip_height_m, metal);
    label(pane.quads, Label::Mirror);
    return pane;
}

Scene room(std::uint64_t seed) {
    Scene scene;
    scene.ambient = 0.4;
    Furnisher furnish(scene, seed, 2);
    furnish.floorAndCeiling(kRoom, Furnisher::Covering::Parquet);
    furnish.ceilingLamp(2.0, 2.2, kRoom.height, 0.5);
    walls(furnish);
    furniture(furnish);
    scene.figures = {reflected(scene), strip(scene, seed)};
    return scene;
}

/** From before the desk to below its edge, along it and back. */
Motion crawl(std::uint64_t seed) {
    const std::vector<Vector3d> eyes{{2.1, 2.0, 1.05},  {2.05, 1.8, 0.95},  {1.9, 1.4, 0.7},
                                     {1.8, 1.1, 0.5},   {1.75, 0.95, 0.45}, {1.6, 0.9, 0.42},
                                     {1.45, 0.88, 0.4}, {1.35, 0.95, 0.42}, {1.5, 1.0, 0.45},
                                     {1.7, 1.2, 0.6},   {1.9, 1.6, 0.85},   {2.05, 1.9, 1.0}};
    std::vector<Vector3d> targets;
    for (const Vector3d& eye : eyes)
        targets.emplace_back(1.6 + 0.5 * (eye.x() - 1.6), 0, 0.15 + 0.45 * (eye.z() - 0.4));
    return handHeld({eyes, 0.9, false}, {targets, 0.9, false}, {}, seed);
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return room(seed); };
    const auto still = [](double) { return SE3(); };
    world.movers = {{"", still, std::nullopt, false, Mover::SeenBy::Color},
                    {"", still, SE3(), false, Mover::SeenBy::Depth}};
    world.exposure = [](double t) { return dim(t, 1.1); };
    world.motion = crawl(seed);
    return world;
}
}  // namespace

Scenario underDesk() {
    return {"under-desk", "hand-held under a desk: dim, near, beside a mirror", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
