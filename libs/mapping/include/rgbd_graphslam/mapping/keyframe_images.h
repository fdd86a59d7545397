/** Where maps get the images of keyframes. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <functional>
#include <string>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** A keyframe with its images and its pose. */
struct Keyframe3D {
    std::size_t index;  // in the trajectory given
    StampedPose pose;   // of the color image
    /** When the depth image was taken; the stamp of the color image where this is not known. */
    double depth_stamp_s;
    RgbdImage image;
    Camera camera;
    SE3 T_base_cam;  // on the robot
};

/** Images of one camera during one session. */
class KeyframeImages {
  public:
    using Consume = std::function<void(const Keyframe3D&)>;
    using Note = std::function<void(const mrpt::obs::CObservation&)>;

    virtual ~KeyframeImages() = default;

    /** Calls consume for each of the keyframes that there are images of, in the order in which
     *  they were taken.
     *  \param keyframes in order of time
     *  \param label of the progress bar
     *  \param note gets everything else that is stored as well, such as readings of sensors, in
     *         its place between the images; without it, reading ends at the last keyframe
     *  \return how many keyframes were passed on
     *  \throws Error when there is not a single one, or what is stored is damaged */
    virtual std::size_t forEach(const Trajectory& keyframes, const std::string& label,
                                const Consume& consume, const Note& note = {}) const = 0;
};

}  // namespace rgbd_graphslam
