/** The stock of materials of a Furnisher. */
#include "rgbd_graphslam/synth/furniture.h"
#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

namespace {
template <class Paint>
std::vector<int> stock(Scene& scene, int count, double tile_m, double glow, Paint paint) {
    std::vector<int> materials;
    materials.reserve(count);
    for (int i = 0; i < count; ++i) materials.push_back(scene.addMaterial(paint(i), tile_m, glow));
    return materials;
}
}  // namespace

Furnisher::Furnisher(Scene& scene, std::uint64_t seed, int variety)
    : scene_(scene), random_(Random::of(seed, 1)) {
    Random& r = random_;
    const Bgr walls[] = {{196, 216, 222}, {205, 205, 190}, {170, 205, 215}, {200, 190, 200}};
    const Bgr woods[] = {{70, 110, 160}, {45, 70, 110}, {130, 165, 195}, {30, 45, 70}};
    plaster_ = stock(scene, 4, 2.6, 0, [&](int i) { return paintPlaster(walls[i], 9, r); });
    woods_ = stock(scene, 4, 0.9, 0, [&](int i) { return paintWood(woods[i], r); });
    fabrics_ = stock(scene, 4, 0.35, 0, [&](int) { return paintFabric(quietColor(r), r); });
    clothes_ = stock(scene, 3, 0.45, 0, [&](int) { return paintFabric(vividColor(r), r); });
    metals_ =
        stock(scene, 2, 0.5, 0, [&](int i) { return paintMetal(Bgr::all(i == 0 ? 165 : 70), r); });
    posters_ = stock(scene, 8 * variety, 0, 0, [&](int) { return paintPoster(r); });
    arts_ = stock(scene, 4 * variety, 0, 0, [&](int) { return paintArt(r); });
    papers_ = stock(scene, 5 * variety, 0, 0, [&](int) { return paintPaper(r); });
    screens_ = stock(scene, 3, 0, 0.55, [&](int) { return paintScreen(r); });
    boxes_ = stock(scene, 3, 0, 0, [&](int) { return paintCardboard(r); });
    packages_ = stock(scene, 6 * variety, 0, 0, [&](int) { return paintPackage(r); });
    spines_ = stock(scene, 2, 0, 0, [&](int) { return paintBookSpines(24, r); });
    doors_ = stock(scene, 2, 0, 0, [&](int i) { return paintDoor(woods[i], r); });
    windows_ = stock(scene, 2, 0, 0.9, [&](int) { return paintWindow(r); });
    rugs_ = stock(scene, 2, 0, 0, [&](int) { return paintRug(r); });
    floors_ = {scene.addMaterial(paintParquet(r), 2.4),
               scene.addMaterial(paintCarpet(Bgr(95, 85, 80), r), 1.3),
               scene.addMaterial(paintTiles(Bgr(165, 172, 175), r), 1.6)};
    bricks_ = scene.addMaterial(paintBricks(r), 1.1);
    ceiling_ = scene.addMaterial(paintCeiling(r), 0.6);
    lamp_ = scene.addMaterial(paintPlaster(Bgr(245, 252, 255), 2, r), 0, 1);
    keyboard_ = scene.addMaterial(paintKeyboard(r));
    leaves_ = scene.addMaterial(paintLeaves(r));
    whiteboard_ = scene.addMaterial(paintWhiteboard(r));
    clock_ = scene.addMaterial(paintClock());
    white_ = scene.addMaterial(paintMetal(Bgr(215, 218, 220), r), 0.7);
    black_ = scene.addMaterial(paintMetal(Bgr(38, 38, 40), r), 0.4);
    face_ = scene.addMaterial(paintFace(r));
}

Skin Furnisher::anyOf(const std::vector<int>& materials) {
    return {materials[random_.below(static_cast<int>(materials.size()))]};
}

Skin Furnisher::spine() {
    const int count = 24;
    const double left = static_cast<double>(random_.below(count)) / count;
    return {spines_[random_.below(2)], {left, 0}, {left + 1.0 / count, 1}};
}

}  // namespace rgbd_graphslam::synth
