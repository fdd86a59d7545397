/** A cart stands still long enough to be mapped; then someone pushes it through the picture and out
 *  of it. */
#include <algorithm>

#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "walker.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
constexpr double kGrasped_s = 3, kReleased_s = 6.2;
constexpr double kReach_m = 0.75;
constexpr double kLate_s = 1.6;  // the walk begins so long after the film

/** Pushed while it is grasped, and where it was left before and after. */
SE3 pushed(const Walker& walker, double t) {
    SE3 pose = walker.trunk(std::clamp(t, kGrasped_s, kReleased_s) - kLate_s) *
               SE3(Eigen::Matrix3d::Identity(), {kReach_m, 0, 0});
    pose.t.z() = 0;
    return pose;
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = officeWithPeople(1, seed);
        Random random = Random::of(seed, 24);
        scene.figures.push_back(cart(scene, random));
        lightFiguresAt(scene, 3.1, 2.7);
        return scene;
    };
    Random random = Random::of(seed, 25);
    const Walker walker({{5.2, 3.4, 0}, {1.5, 1.95, 0}, {2.2, 1.6, 0}, {5.2, 2.6, 0}},
                        random.uniform(0.75, 0.9));
    addWalker(walker, "person", world.movers, -kLate_s);
    world.movers.push_back(
        {"cart", [=](double t) { return pushed(walker, t); }, pushed(walker, kGrasped_s)});
    world.exposure = drifting;
    world.motion =
        watchFrom({0.95, 3.8, 1.5}, {5.0, 2.4, 0.9}, {0.15, 0.3, 0.12}, {0, 0.9, 0}, seed);
    return world;
}
}  // namespace

Scenario pushedCart() {
    return {"pushed-cart",
            "a cart that stood still is pushed through the view of a hand-held camera", 1, 300,
            build};
}

}  // namespace rgbd_graphslam::synth
