/** Bodies of movers. */
#pragma once
#include "rgbd_graphslam/synth/random.h"
#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** Lights all figures of a scene as if they stood at a place on its floor. */
void lightFiguresAt(Scene& scene, double x, double y);

/** A leaf that fills y in [0, width] of its frame, its hinge at y = 0; posters on both sides. */
MovingBody doorLeaf(Scene& scene, double width, double height, Random& random);

/** A trolley full of parcels, its middle at the origin, pushed along +x. */
MovingBody cart(Scene& scene, Random& random);

/** A bar with stickers along +x, from 0 to `length`. */
MovingBody armSegment(Scene& scene, double length, double thickness, Random& random);

/** Two fingers that reach along +x from a palm at the origin. */
MovingBody gripper(Scene& scene, Random& random);

}  // namespace rgbd_graphslam::synth
