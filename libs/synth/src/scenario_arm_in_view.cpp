/** The robot's own arm is in the picture: still for the most part, moving for some seconds. */
#include <cmath>

#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);
constexpr double kForearm_m = 0.36;

SE3 turnedUp(double pitch_rad, double yaw_rad = 0) {
    return {rotationExp({0, 0, yaw_rad}) * rotationExp({0, -pitch_rad, 0}), Vector3d::Zero()};
}

SE3 shiftedBy(double x, double y, double z) {
    return {Eigen::Matrix3d::Identity(), {x, y, z}};
}

/** 0 but between 4 and 7 s. */
double swing(double t) {
    return (easing(t, 4, 4.5) - easing(t, 6.5, 7)) * std::sin(2 * kPi * 0.5 * (t - 4));
}

/** The forearm in axes of the camera that look ahead, left and up. */
SE3 forearm(double t) {
    return shiftedBy(0.27, -0.2, -0.24) * turnedUp(0.2 + 0.25 * swing(t), 0.3 + 0.3 * swing(t));
}

SE3 hand(double t) {
    return forearm(t) * shiftedBy(kForearm_m, 0, 0) * turnedUp(0.1 - 0.4 * swing(t), 0.2);
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = apartment(seed);
        Random random = Random::of(seed, 22);
        scene.figures = {armSegment(scene, kForearm_m, 0.09, random), gripper(scene, random)};
        lightFiguresAt(scene, 2.5, 1.0);
        return scene;
    };
    const double spacing = 1.0;
    world.motion = planarRobot(
        {evenlySpaced({{1.3, 1.0, 0}, {8.6, 1.0, 0}, {8.6, 4.0, 0}, {1.3, 4.0, 0}}, spacing, true),
         spacing / 0.5, true});
    const SE3 T_cam_ahead(forwardToOptical(), Vector3d::Zero());
    for (const auto& part : {forearm, hand})
        world.movers.push_back({"arm",
                                [=, camera = world.motion.T_world_cam](double t) {
                                    return camera(t) * T_cam_ahead * part(t);
                                },
                                std::nullopt, true});
    world.exposure = drifting;
    return world;
}
}  // namespace

Scenario armInView() {
    return {"arm-in-view", "planar robot whose own arm is in the picture and sometimes moves", 1,
            300, build};
}

}  // namespace rgbd_graphslam::synth
