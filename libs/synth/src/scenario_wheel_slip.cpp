/** A planar robot whose wheels lose their hold now and then, in full sight. */
#include "deceits.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

/** Every three seconds or so: spinning, locked, or turning one-sidedly. */
std::vector<SlipEpisode> slipsOf(double duration_s, std::uint64_t seed) {
    Random random = Random::of(seed, 31);
    std::vector<SlipEpisode> slips;
    double t = 3;
    while (t < duration_s) {
        SlipEpisode slip{t, t + random.uniform(0.4, 1.2), 1, 0};
        const int kind = random.below(3);
        if (kind == 0) slip.way_factor = random.uniform(1.5, 3);
        if (kind == 1) slip.way_factor = random.uniform(0, 0.3);
        if (kind == 2) slip.turn_rad_s = random.uniform(0.3, 0.8) * (random.chance(0.5) ? 1 : -1);
        slips.push_back(slip);
        t = slip.to_s + random.uniform(1.5, 3);
    }
    return slips;
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return apartment(seed); };
    world.exposure = drifting;
    const std::vector<Vector3d> corners{{1.4, 1.05, 0}, {4.2, 1.05, 0}, {4.2, 4, 0}, {1.4, 4, 0}};
    const double spacing = 0.9;
    world.motion = planarRobot({evenlySpaced(corners, spacing, true), spacing / 0.45, true});
    world.wheels.slip_chance = 0;
    world.slips = slipsOf(60, seed);
    return world;
}
}  // namespace

Scenario wheelSlip() {
    return {"wheel-slip", "planar robot whose wheels spin, lock and turn on the spot", 1, 750,
            build};
}

}  // namespace rgbd_graphslam::synth
