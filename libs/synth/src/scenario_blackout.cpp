/** The camera sees nothing for 2, 5 or 10 s (sessions 1, 2 and 3), then again what it has seen
 *  before. The way goes on all the while, which only the other sensors tell. */
#include <iterator>

#include "deceits.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
constexpr double kLengths_s[] = {2, 5, 10};
/** Cheap units wander and warm up. */
constexpr double kForceWalk = 5e-4, kRateWalk = 2e-5;

World hand(int session, std::uint64_t seed) {
    World world;
    world.scene = [=] { return officeRoom(Office::Furnished, seed); };
    world.exposure = drifting;
    world.motion = strollAround({3.15, 2.6, 1.45}, 1.1, 0.85, 15, 0.35, seed);
    world.inertial.force_walk = kForceWalk;
    world.inertial.rate_walk = kRateWalk;
    world.blackouts = {{15, 15 + kLengths_s[session - 1]}};
    return world;
}

World robot(int session, std::uint64_t seed) {
    World world;
    world.scene = [=] { return apartment(seed); };
    world.exposure = drifting;
    const std::vector<Vector3d> corners{{1.4, 1.05, 0}, {4.2, 1.05, 0}, {4.2, 4, 0}, {1.4, 4, 0}};
    const double spacing = 0.9;
    world.motion = planarRobot({evenlySpaced(corners, spacing, true), spacing / 0.45, true});
    world.inertial.force_walk = kForceWalk;
    world.inertial.rate_walk = kRateWalk;
    world.blackouts = {{22, 22 + kLengths_s[session - 1]}};
    return world;
}
}  // namespace

Scenario blackout() {
    return {"blackout", "hand-held in the office; nothing is seen for 2, 5 or 10 s", 3, 780, hand};
}

Scenario blackoutRobot() {
    return {"blackout-robot", "planar robot in one room; nothing is seen for 2, 5 or 10 s", 3, 1050,
            robot};
}

}  // namespace rgbd_graphslam::synth
