/** A robot follows people who walk ahead at its own pace: their image hardly moves. */
#include "bodies.h"
#include "deceits.h"
#include "filming.h"
#include "places.h"
#include "rgbd_graphslam/synth/furniture.h"
#include "walker.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
constexpr double kSpeed = 0.66;  // m/s
constexpr double kSpacing_m = 1.1;

/** Round the storey, parallel to the way in the middle of its corridors.
 *  \param ahead_m start of the way \param left_m of the middle */
std::vector<Vector3d> parallelWay(double ahead_m, double left_m) {
    const double low_x = 2.2 + left_m, high_x = 21.8 - left_m, low_y = 1.1 + left_m,
                 high_y = 12.5 - left_m;
    return {{6 + ahead_m, low_y, 0},
            {high_x, low_y, 0},
            {high_x, high_y, 0},
            {low_x, high_y, 0},
            {low_x, low_y, 0}};
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] {
        Scene scene = storey(seed);
        Furnisher furnish(scene, seed + 1);
        for (int person = 0; person < 2; ++person) furnish.person();
        lightFiguresAt(scene, 8, 1.1);
        return scene;
    };
    Random random = Random::of(seed, 21);
    const double near = random.uniform(1.3, 1.5), far = random.uniform(1.5, 1.8);
    addWalker(Walker(parallelWay(near, 0.25), kSpeed), "person 1", world.movers);
    addWalker(Walker(parallelWay(far, -0.3), kSpeed), "person 2", world.movers);
    world.exposure = drifting;
    world.motion =
        planarRobot({evenlySpaced(parallelWay(0, 0), kSpacing_m, true), kSpacing_m / kSpeed, true});
    return world;
}
}  // namespace

Scenario followMe() {
    return {"follow-me", "planar robot behind two people who walk at its pace", 1, 300, build};
}

}  // namespace rgbd_graphslam::synth
