/** The first thing the camera sees is a crowd that walks off, all one way; the room comes after. */
#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "walker.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
constexpr int kRows = 2, kColumns = 3;

/** From a place in the crowd to the door in the west wall and, unseen, beyond. */
Walker leaver(int row, int column, Random& random) {
    const Vector3d ahead(-0.88, -0.47, 0), left(0.47, -0.88, 0);
    const Vector3d start = Vector3d(4.5, 3.2, 0) + (1.15 + 0.75 * row) * ahead +
                           (0.55 * (column - 1) + random.uniform(-0.08, 0.08)) * left;
    const Vector3d door(0.1, 0.8, 0);
    return {{start, door, {-6, 0.8, 0}, {-6, -6, 0}, {4.5, -6, 0}}, random.uniform(0.75, 0.95)};
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = officeWithPeople(kRows * kColumns, seed);
        lightFiguresAt(scene, 3.1, 2.7);
        return scene;
    };
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            Random random = Random::of(seed, 26, row * kColumns + column);
            addWalker(leaver(row, column, random),
                      "person " + std::to_string(row * kColumns + column + 1), world.movers,
                      random.uniform(0.2, 0.5));
        }
    world.exposure = drifting;
    world.motion =
        watchFrom({4.5, 3.2, 1.5}, {1.2, 1.6, 1.1}, {0.15, 0.25, 0.12}, {0.3, 1.0, 0.1}, seed);
    return world;
}
}  // namespace

Scenario startsInCrowd() {
    return {"starts-in-crowd", "hand-held in a crowd that walks away, all one way", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
