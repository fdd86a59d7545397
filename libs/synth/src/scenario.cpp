#include "rgbd_graphslam/synth/scenario.h"

#include <cmath>

#include "places.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);

/** A camera's automatic exposure hunts slowly by some per cent. */
std::function<Exposure(double)> driftingExposure() {
    return [](double t) {
        Exposure exposure;
        exposure.brightness =
            1 + 0.08 * std::sin(2 * kPi * t / 11) + 0.05 * std::sin(2 * kPi * t / 4.3 + 1);
        return exposure;
    };
}

World office(int, std::uint64_t seed) {
    World world;
    world.scene = officeRoom(seed);
    world.exposure = driftingExposure();
    const double step = 15.0 / 12;
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * kPi * i / 12;
        eyes.emplace_back(3.15 + 1.15 * std::cos(angle), 2.6 + 0.9 * std::sin(angle),
                          1.45 + 0.12 * std::sin(2 * angle));
        targets.emplace_back(3.15 + 3.2 * std::cos(angle + 0.35),
                             2.6 + 2.6 * std::sin(angle + 0.35), 0.95 + 0.15 * std::cos(3 * angle));
    }
    world.motion = handHeld({eyes, step, true}, {targets, step, true}, {}, seed);
    return world;
}
}  // namespace

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> all{
        {"office", "hand-held loop of 15 s through a furnished office", 1, 450, office},
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
