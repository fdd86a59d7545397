/** The scenarios: a place, a motion through it and what makes it hard. */
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rgbd_graphslam/synth/lens_effect.h"
#include "rgbd_graphslam/synth/motion.h"
#include "rgbd_graphslam/synth/mover.h"
#include "rgbd_graphslam/synth/robot_sensors.h"
#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** Brightness of the color camera at a time. */
struct Exposure {
    double brightness = 1;     // of the picture
    double gain = 1;           // of the amplifier, which multiplies the noise
    double shutter_s = 0.011;  // time over which motion blurs
};

/** One session of a scenario, ready to be filmed. */
struct World {
    /** Builds the scene, which takes a second or two; motions are known without it. */
    std::function<Scene()> scene;
    Motion motion;
    std::function<Exposure(double t)> exposure;
    /** One for each of the scene's figures. */
    std::vector<Mover> movers;
    /** Null: nothing between scene and sensor. */
    std::shared_ptr<const LensEffect> lens;
    /** The scene of the same film without movers, where more differs than the movers; empty: the
     *  same scene. */
    std::function<Scene()> scene_without_movers;
    /** Glass, which cameras look through and lasers see. */
    std::vector<Quad> panes = {};
    /** Times [from, to) at which the camera is covered. */
    std::vector<std::pair<double, double>> covered;
    /** The same, where that is all that is wrong: the way goes on as if nothing were. */
    std::vector<std::pair<double, double>> blackouts;
    InertialModel inertial;
    WheelModel wheels;
    std::vector<SlipEpisode> slips;
};

/** The same world without what deceives: movers are gone or rest, nothing is before the lens, the
 *  world is not carried, no blackouts, and the wheels hold the floor. */
World withoutMovers(const World& world);

/** A scenario by name, and how to build its world. */
struct Scenario {
    std::string name;
    std::string about;
    int sessions = 1;
    /** Frames when the user asks for no number. */
    int frames = 450;
    /** \param session from 1 \param seed of everything random */
    std::function<World(int session, std::uint64_t seed)> build;
};

/** All scenarios, in the order in which they are listed. */
const std::vector<Scenario>& scenarios();

/** \throws Error that lists the names when there is none of this name */
const Scenario& findScenario(const std::string& name);

}  // namespace rgbd_graphslam::synth
