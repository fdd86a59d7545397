#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

namespace {
void addAt(const SE3& place, const MovingBody& body, std::vector<Quad>& quads) {
    for (Quad quad : body.quads) {
        for (Eigen::Vector3d& corner : quad.corners) corner = place * corner;
        quads.push_back(quad);
    }
}

Scene withResting(Scene scene, const std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < movers.size(); ++i)
        if (movers[i].at_rest) addAt(*movers[i].at_rest, scene.figures[i], scene.quads);
    scene.figures.clear();
    return scene;
}
}  // namespace

World withoutMovers(const World& world) {
    World calm = world;
    calm.scene = [scene = world.scene_without_movers ? world.scene_without_movers : world.scene,
                  movers = world.movers] { return withResting(scene(), movers); };
    calm.movers.clear();
    calm.lens.reset();
    calm.motion.T_inertial_world = nullptr;
    calm.blackouts.clear();
    calm.slips.clear();
    return calm;
}

}  // namespace rgbd_graphslam::synth
