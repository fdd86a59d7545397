/** Things that move by themselves while a film is made. */
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam::synth {

/** How one of a scene's figures moves. Pixels that show it are masked. */
struct Mover {
    /** Names what the figure is a part of, e.g. "person 1"; empty: it takes up no space, as an
     *  image in a mirror. */
    std::string name;
    /** Maps the figure's coordinates to the world at a time (s). */
    std::function<SE3(double)> pose;
    /** Its place in the film without movers; none: it is not there. */
    std::optional<SE3> at_rest;
    /** A part of the camera's carrier. */
    bool carried = false;
    /** A mirror's face is seen by the depth camera alone, the image in it by the color camera. */
    enum class SeenBy { Both, Color, Depth } seen_by = SeenBy::Both;
};

/** Where a thing is put that is not to be seen. */
SE3 outOfSight();

}  // namespace rgbd_graphslam::synth
