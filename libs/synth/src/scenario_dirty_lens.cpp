/** A lens with specks and smears, which stay where they are as the world moves. */
#include "deceits.h"
#include "dirt.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return officeRoom(Office::Furnished, seed); };
    world.exposure = drifting;
    world.motion = strollAround({3.15, 2.6, 1.45}, 1.1, 0.85, 15, 0.35, seed);
    world.lens = std::make_shared<LensDirt>(seed);
    return world;
}
}  // namespace

Scenario dirtyLens() {
    return {"dirty-lens", "the office through a lens with specks and smears", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
