/** On the second day chairs and boxes stand elsewhere; nothing moves while the camera runs. */
#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "rgbd_graphslam/synth/furniture.h"

namespace rgbd_graphslam::synth {

namespace {
Scene furnished(int day, std::uint64_t seed) {
    Scene scene = officeRoom(Office::Furnished, seed);
    Furnisher furnish(scene, seed + 1);
    const bool first = day == 1;
    furnish.chair(first ? standing(4.7, 1.75, 0, 2.8) : standing(5.3, 3.2, 0, -2.4));
    furnish.chair(first ? standing(1.7, 3.7, 0, -0.6) : standing(1.45, 2.0, 0, 0.9));
    furnish.cardboardPile(first ? standing(5.4, 2.9, 0, 0.3) : standing(4.3, 3.6, 0, 1.2), 2);
    return scene;
}

World build(int session, std::uint64_t seed) {
    World world;
    world.scene = [=] { return furnished(session, seed); };
    world.scene_without_movers = [=] { return furnished(1, seed); };
    world.exposure = [=](double t) { return drifting(t + 7 * (session - 1)); };
    const double ahead = session == 1 ? 0.35 : -0.35;
    world.motion = strollAround({3.15, 2.6, 1.45}, session == 1 ? 1.1 : 0.95,
                                session == 1 ? 0.85 : 0.8, 15, ahead, seed + 100 * session);
    return world;
}
}  // namespace

Scenario chairMoved() {
    return {"chair-moved",
            "an office on two days: two chairs and boxes stand elsewhere on the second", 2, 300,
            build};
}

}  // namespace rgbd_graphslam::synth
