/** A corridor that ends in a pane of glass, which the camera looks through. */
#include "deceits.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
constexpr double kPane_m = 20;  // along the corridor of the storey

Quad pane() {
    Quad quad;
    quad.uv.fill(Eigen::Vector2d::Zero());  // never drawn
    quad.corners = {Eigen::Vector3d(kPane_m, 0, 0), Eigen::Vector3d(kPane_m, 2.2, 0),
                    Eigen::Vector3d(kPane_m, 2.2, 2.4), Eigen::Vector3d(kPane_m, 0, 2.4)};
    return quad;
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return storey(seed); };
    world.panes = {pane()};
    world.exposure = drifting;
    const std::vector<Eigen::Vector3d> ends{{3, 1.1, 0}, {18.5, 1.1, 0}};
    const double spacing = 1.1;
    world.motion = planarRobot({evenlySpaced(ends, spacing, false), spacing / 0.66, false});
    return world;
}
}  // namespace

Scenario glassCorridor() {
    return {"glass-corridor", "planar robot toward a pane of glass; with --scanner a laser sees it",
            1, 700, build};
}

}  // namespace rgbd_graphslam::synth
