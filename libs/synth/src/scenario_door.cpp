/** A door of half the picture's width opens and closes. */
#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
/** Angle of the leaf (rad): opens from 2.5 s on, closes from 6 s on. */
double opened(double t) {
    return 1.65 * (easing(t, 2.5, 4.3) - easing(t, 6, 7.8));
}

/** In the doorway between the two rooms, turning into the study. */
SE3 leaf(double angle_rad) {
    return standing(5.0, 0.45, 0, -angle_rad);
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = apartment(seed);
        Random random = Random::of(seed, 23);
        scene.figures = {doorLeaf(scene, 1.1, 2.05, random)};
        scene.figures[0].lit_at.translation() = Eigen::Vector3d(4.2, 0.45, 0);
        return scene;
    };
    world.movers = {{"door", [](double t) { return leaf(opened(t)); }, leaf(0)}};
    world.exposure = drifting;
    world.motion =
        watchFrom({3.2, 1.15, 1.4}, {5, 1.05, 1.15}, {0.15, 0.25, 0.12}, {0, 0.35, 0.1}, seed);
    return world;
}
}  // namespace

Scenario door() {
    return {"door", "hand-held before a door that opens and closes", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
