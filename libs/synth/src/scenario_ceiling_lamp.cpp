/** Up at the ceiling of a dark room: the lamp saturates, and its reflections between the lenses
 * move across the picture as the camera turns. */
#include "deceits.h"
#include "filming.h"
#include "flare.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

Motion lookUp(std::uint64_t seed) {
    const std::vector<Vector3d> eyes{{3.4, 1.7, 1.45},  {3.4, 1.75, 1.45}, {3.45, 1.8, 1.45},
                                     {3.5, 1.85, 1.5},  {3.5, 1.9, 1.5},   {3.4, 1.95, 1.5},
                                     {3.3, 1.95, 1.5},  {3.2, 1.9, 1.5},   {3.2, 1.8, 1.45},
                                     {3.3, 1.75, 1.45}, {3.4, 1.7, 1.45}};
    const std::vector<Vector3d> targets{{5.6, 2.6, 1.2}, {5.6, 2.6, 1.25}, {5.5, 2.7, 1.7},
                                        {5.3, 2.8, 2.3}, {5.0, 2.9, 2.6},  {4.5, 3.3, 2.7},
                                        {4.2, 3.6, 2.7}, {4.5, 3.4, 2.6},  {5.0, 3.0, 2.1},
                                        {5.5, 2.7, 1.5}, {5.6, 2.6, 1.2}};
    return handHeld({eyes, 1, false}, {targets, 1, false}, {}, seed);
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = officeRoom(Office::Furnished, seed);
        scene.ambient = 0.4;
        return scene;
    };
    world.lens =
        std::make_shared<LensFlare>(std::vector<Vector3d>{{4.6, 2.6, 2.65}, {1.8, 2.6, 2.65}});
    world.exposure = [](double t) { return dim(t, 0.35); };
    world.motion = lookUp(seed);
    return world;
}
}  // namespace

Scenario ceilingLamp() {
    return {"ceiling-lamp", "hand-held in a dark room, up at a lamp that flares in the lens", 1,
            300, build};
}

}  // namespace rgbd_graphslam::synth
