#include "rgbd_graphslam/synth/scenario.h"

#include <cmath>

#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/random.h"
#include "walker.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);

/** The lights go out between 4 and 6 s and come on again after 11 s; the camera opens its shutter
 *  for as long as 30 Hz lets it and turns its amplifier up. */
Exposure failingLight(double t) {
    const auto step = [](double x) { return 0.5 - 0.5 * std::cos(kPi * std::clamp(x, 0.0, 1.0)); };
    const double dark = step((t - 4) / 2) - step((t - 11) / 2);
    Exposure exposure = drifting(t);
    exposure.brightness *= 1 - 0.82 * dark;
    exposure.gain = 1 + 3 * dark;
    exposure.shutter_s += 0.020 * dark;
    return exposure;
}

/** Control points of a walk and of its gaze, one pair every `spacing` meters. */
struct Walk {
    std::vector<Vector3d> eyes, targets;
};

/** Along a closed way at eye height, looking 2 m ahead and to both sides in turn.
 *  \param sway_m how far to the sides */
Walk walkRound(const std::vector<Vector3d>& corners, double spacing_m, double sway_m) {
    Walk walk;
    walk.eyes = evenlySpaced(corners, spacing_m, true);
    const int count = static_cast<int>(walk.eyes.size());
    const int ahead = static_cast<int>(std::lround(2.0 / spacing_m));
    for (int i = 0; i < count; ++i) {
        const Vector3d& front = walk.eyes[(i + ahead) % count];
        const Vector3d side = (front - walk.eyes[i]).cross(Vector3d::UnitZ()).normalized();
        walk.targets.push_back(front + sway_m * std::sin(2 * kPi * 0.09 * i) * side -
                               Vector3d(0, 0, 0.35 + 0.1 * std::sin(0.4 * i)));
    }
    return walk;
}

World office(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return officeRoom(Office::Furnished, seed); };
    world.exposure = drifting;
    world.motion = strollAround({3.15, 2.6, 1.45}, 1.1, 0.85, 15, 0.35, seed);
    return world;
}

World dark(int session, std::uint64_t seed) {
    World world = office(session, seed);
    world.exposure = failingLight;
    return world;
}

World desk(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return officeRoom(Office::DeskFree, seed); };
    world.exposure = drifting;
    Random random = Random::of(seed, 8);
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < 30; ++i) {
        const double across = std::sin(2 * kPi * i / 10);
        eyes.emplace_back(1.5 + 0.75 * across + random.uniform(-0.1, 0.1),
                          1.25 + 0.25 * std::cos(2 * kPi * i / 6),
                          1.2 + 0.15 * std::sin(2 * kPi * i / 7));
        const double z = 0.82 + random.uniform(-0.1, 0.15), y = 0.35 + random.uniform(-0.1, 0.1);
        targets.emplace_back(1.5 - 0.35 * across + random.uniform(-0.2, 0.2), y, z);
    }
    world.motion = handHeld({eyes, 0.5, true}, {targets, 0.5, true}, {0.008, 0.012}, seed);
    return world;
}

World corridorLoop(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return storey(seed); };
    world.exposure = drifting;
    // Starts in the corridor's middle, so that the end meets the beginning on a straight.
    const std::vector<Vector3d> corners{
        {6, 1.1, 0}, {21.8, 1.1, 0}, {21.8, 12.5, 0}, {2.2, 12.5, 0}, {2.2, 1.1, 0}};
    const double spacing = 1.1;
    world.motion = planarRobot({evenlySpaced(corners, spacing, true), spacing / 0.66, true});
    return world;
}

const std::vector<Vector3d> kApartmentRound{
    {1.3, 1.0, 1.4}, {8.6, 1.0, 1.4}, {8.6, 4.0, 1.4}, {1.3, 4.0, 1.4}};

World twoSessions(int session, std::uint64_t seed) {
    World world;
    world.scene = [=] { return apartment(seed); };
    world.exposure = drifting;
    std::vector<Vector3d> corners = kApartmentRound;
    if (session == 2) {
        // The other way round, nearer to the middle, lower, from another start.
        corners = {{8.3, 1.2, 1.15}, {1.6, 1.2, 1.15}, {1.6, 3.8, 1.25}, {8.3, 3.8, 1.25}};
        world.exposure = [](double t) {
            Exposure exposure = drifting(t + 20);
            exposure.brightness *= 0.8;
            return exposure;
        };
    }
    const double spacing = 0.5, step = spacing / 0.5;
    const Walk walk = walkRound(corners, spacing, session == 2 ? 0.8 : 0.5);
    world.motion = handHeld({walk.eyes, step, true}, {walk.targets, step, true},
                            {0.006, 0.009, 0.008}, seed + 100 * session);
    return world;
}

World kidnapped(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return apartment(seed); };
    world.exposure = drifting;
    const double spacing = 0.4, step = 0.8;
    const Walk round = walkRound(kApartmentRound, spacing, 0.5);
    Walk walk;
    const auto visit = [&](int i) {
        walk.eyes.push_back(round.eyes[i]);
        walk.targets.push_back(round.targets[i]);
    };
    for (int i = 0; i < 32; ++i) visit(i);  // through both rooms
    for (int i = 5; i < 22; ++i) visit(i);  // carried back, covered
    world.covered = {{30 * step, 30 * step + 3}};
    world.motion = handHeld({walk.eyes, step, false}, {walk.targets, step, false},
                            {0.006, 0.009, 0.006}, seed);
    return world;
}

World lowTexture(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return plainRoom(seed); };
    world.exposure = drifting;
    world.motion = strollAround({2.9, 2.5, 1.4}, 0.8, 0.6, 20, 0.3, seed);
    return world;
}

World noStructure(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return paintedWall(seed); };
    world.exposure = drifting;
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < 16; ++i) {
        const double angle = 2 * kPi * i / 16;
        eyes.emplace_back(1.5 + 0.25 * std::cos(2 * angle), 2.0 * std::sin(angle),
                          2 + 0.35 * std::sin(2 * angle));
        targets.emplace_back(0, 2.3 * std::sin(angle), 2 + 0.3 * std::sin(2 * angle));
    }
    world.motion = handHeld({eyes, 1.25, true}, {targets, 1.25, true}, {}, seed);
    return world;
}

World dynamic(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return officeWithPeople(2, seed); };
    for (int person = 0; person < 2; ++person) {
        const std::vector<Vector3d> way =
            person == 0
                ? std::vector<Vector3d>{{1.6, 1.9, 0}, {4.9, 1.9, 0}, {4.9, 3.3, 0}, {1.6, 3.3, 0}}
                : std::vector<Vector3d>{{4.4, 3.1, 0}, {2.2, 2.3, 0}, {3.3, 1.9, 0}};
        addWalker(Walker(way, person == 0 ? 0.9 : 0.7), "person " + std::to_string(person + 1),
                  world.movers);
    }
    world.exposure = drifting;
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * kPi * i / 12;
        eyes.emplace_back(0.95 + 0.12 * std::cos(angle), 3.9 + 0.3 * std::sin(angle),
                          1.5 + 0.12 * std::sin(2 * angle));
        targets.emplace_back(5.0, 2.2 + 1.2 * std::sin(angle), 1.0);
    }
    world.motion = handHeld({eyes, 1.25, true}, {targets, 1.25, true}, {}, seed);
    return world;
}

World longRun(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return apartment(seed); };
    world.exposure = drifting;
    const double spacing = 1.0;
    world.motion = planarRobot({evenlySpaced(kApartmentRound, spacing, true), spacing / 0.5, true});
    return world;
}
}  // namespace

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> all{
        {"office", "hand-held loop through a furnished office", 1, 450, office},
        {"desk", "close to a cluttered desk, fast and shaky", 1, 450, desk},
        {"corridor-loop", "planar robot round a storey of six rooms, back to its start", 1, 3000,
         corridorLoop},
        {"two-sessions", "two rooms on two days: other way round, other light, other height", 2,
         1200, twoSessions},
        {"kidnapped", "camera covered for 3 s and carried elsewhere in the mapped rooms", 1, 1100,
         kidnapped},
        {"low-texture", "plain walls and blocks: few features, strong structure", 1, 600,
         lowTexture},
        {"no-structure", "one flat wall full of pictures: depth says nothing", 1, 600, noStructure},
        {"dynamic", "two people walk through the view", 1, 450, dynamic},
        {"dark", "the office while the light fails: little contrast, noise and blur", 1, 450, dark},
        {"long-run", "planar robot that patrols two rooms for as long as is asked", 1, 3600,
         longRun},
        crowd(),
        followMe(),
        door(),
        chairMoved(),
        pushedCart(),
        startsInCrowd(),
        lift(),
        underDesk(),
        ceilingLamp(),
        armInView(),
        dirtyLens(),
        blackout(),
        blackoutRobot(),
        wheelSlip(),
        glassCorridor(),
    };
    return all;
}

const Scenario& findScenario(const std::string& name) {
    std::string names;
    for (const Scenario& scenario : scenarios()) {
        if (scenario.name == name) return scenario;
        names += (names.empty() ? "" : ", ") + scenario.name;
    }
    throw Error("no scenario '" + name + "'", "choose one of " + names);
}

}  // namespace rgbd_graphslam::synth
