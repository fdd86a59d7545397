/** People all around: a fifth to four fifths of the view moves. */
#include <cmath>

#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "walker.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
constexpr int kPeople = 12;

/** Round the middle of the room, some one way, some the other. */
Walker anyWalker(Random& random) {
    const double radius_x = random.uniform(0.6, 1.0), radius_y = random.uniform(0.35, 0.6);
    const Vector3d center(random.uniform(2.2, 2.8), random.uniform(2.7, 3.0), 0);
    const double turn = random.chance(0.5) ? 1 : -1;
    std::vector<Vector3d> way;
    for (int i = 0; i < 8; ++i) {
        const double angle = turn * std::acos(-1.0) * i / 4;
        way.push_back(center + Vector3d(radius_x * std::cos(angle), radius_y * std::sin(angle), 0));
    }
    return {way, random.uniform(0.6, 1.0)};
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = officeWithPeople(kPeople, seed);
        lightFiguresAt(scene, 3.1, 2.7);
        return scene;
    };
    for (int person = 0; person < kPeople; ++person) {
        Random random = Random::of(seed, 20, person);
        const Walker walker = anyWalker(random);
        addWalker(walker, "person " + std::to_string(person + 1), world.movers,
                  random.uniform(0, 10));
    }
    world.exposure = drifting;
    world.motion =
        watchFrom({0.95, 3.8, 1.5}, {5.0, 2.2, 1.0}, {0.15, 0.3, 0.12}, {0, 1.2, 0}, seed);
    return world;
}
}  // namespace

Scenario crowd() {
    return {"crowd", "twelve people walk about before a hand-held camera", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
