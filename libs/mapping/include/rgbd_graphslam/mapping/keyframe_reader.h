/** Keyframe images, read again from the rawlog they came from. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <functional>
#include <string>
#include <utility>

#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** An RGB-D camera of a rawlog. */
struct RecordedCamera {
    RecordedCamera(std::string path, std::string label = {})
        : rawlog(std::move(path)), sensor_label(std::move(label)) {}

    std::string rawlog;
    std::string sensor_label;  // empty = of the first frame
};

/** A keyframe with its images and its pose. */
struct Keyframe3D {
    std::size_t index;  // in the trajectory given
    StampedPose pose;   // of the color image
    /** When the depth image was taken; the stamp of the color image where the rawlog does not say.
     */
    double depth_stamp_s;
    RgbdImage image;
    Camera camera;
    SE3 T_base_cam;  // on the robot
};

/** One pass over the rawlog; calls consume for each of the camera's frames whose stamp is that of a
 *  pose.
 *  \param label of the progress bar
 *  \param note gets every entry of the rawlog; without it, reading ends at the last keyframe
 *  \return how many poses found their frame
 *  \throws Error when not a single one did */
std::size_t forEachKeyframe(const RecordedCamera& camera, const Trajectory& keyframes,
                            const std::string& label,
                            const std::function<void(const Keyframe3D&)>& consume,
                            const std::function<void(const mrpt::obs::CObservation&)>& note = {});

/** Where the camera was when it took the keyframe's depth image: its pose, moved on by what the
 *  trajectory says about the time between the two stamps, up to 16 ms for a Kinect. The pose itself
 *  where the trajectory has no poses close by.
 *  \param trajectory of every frame, in any frame of reference */
SE3 depthPose(const StampedPose& keyframe, double depth_stamp_s, const Trajectory& trajectory);

/** Takes up the stamps of depth images if an entry of a rawlog tells them. */
void noteDepthStamps(const mrpt::obs::CObservation& observation, DepthStamps& stamps);

/** Of the depth image that belongs to a color image. */
double depthStamp(const DepthStamps& stamps, double color_stamp_s);

}  // namespace rgbd_graphslam
