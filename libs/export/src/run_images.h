/** Images of a run as a camera without lens distortion would have taken them. */
#pragma once
#include <functional>
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/mapping/map_inputs.h"

namespace rgbd_graphslam {

struct RunImage {
    int number = 0;    // of the pose in the list asked for
    StampedPose pose;  // of the color image
    Camera camera;     // without distortion
    cv::Mat3b color;   // BGR; gray where the camera is
    cv::Mat1w depth;   // in units of depth_unit_m; 0 = no reading
    double depth_unit_m = 0.001;
};

/** The largest camera of the same image size without distortion that sees nothing but what the
 * given one saw: images have no empty borders. The camera itself when it has no distortion. */
Camera undistortedCamera(const Camera& camera);

/** Keyframes whose place in the map is known, with their index in run.keyframes. */
struct NumberedKeyframe {
    int number = 0;
    StampedPose pose;
};
std::vector<NumberedKeyframe> placedKeyframes(const MapInputs& run);

/** Reads the images of keyframes, or of all frames of the run's own rawlog, one at a time.
 *  RunImage::number counts run.keyframes or run.trajectory.
 *  \param label of the progress bar
 *  \return how many there were
 *  \throws Error when a rawlog is missing, has none of the images, or has those of several cameras
 */
std::size_t forEachImage(const MapInputs& run, bool all_frames, const std::string& label,
                         const std::function<void(const RunImage&)>& consume);

/** "image_000012.jpg" */
std::string imageName(const char* prefix, int number, const char* extension);

/** Atomic; JPEG of high quality or PNG, by the extension. \throws Error */
void writeImage(const std::string& path, const cv::Mat& image);

}  // namespace rgbd_graphslam
