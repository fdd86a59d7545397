/** Keyframe images, read again from the rawlog they came from. */
#pragma once
#include <functional>
#include <string>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

struct Keyframe3D {
    std::size_t index;  // in the trajectory given
    StampedPose pose;
    RgbdImage image;
    Camera camera;
};

/** One pass over the rawlog; calls consume for each frame whose stamp is that of a pose.
 *  \param label of the progress bar
 *  \return how many poses found their frame
 *  \throws Error when not a single one did */
std::size_t forEachKeyframe(const std::string& rawlog, const Trajectory& keyframes,
                            const std::string& label,
                            const std::function<void(const Keyframe3D&)>& consume);

}  // namespace rgbd_graphslam
