/** Calibrations of a recording of ROS messages. */
#pragma once
#include <optional>
#include <string>

#include "bag_survey.h"
#include "image_topics.h"
#include "rgbd_graphslam/dataset/camera_file.h"

namespace rgbd_graphslam {

/** A camera without its lens.
 *  \param rectified whether the images have been rectified: P for K */
Intrinsics pinholeOf(const ros::CameraInfo& info, bool rectified);

/** \param rectified whether the images have been rectified: no distortion
 *  \return nothing for a model that is not known here */
std::optional<Lens> lensOf(const ros::CameraInfo& info, bool rectified);

/** Whether an image topic's images have been rectified, by its name. */
bool isRectified(const std::string& topic);

/** Depth's pose in the color camera's optical frame, from /tf_static, the extrinsics that
 *  RealSense's driver publishes, or those of librealsense's recorder. */
std::optional<SE3> colorFromDepth(const BagSurvey& survey, const ImageChoice& images);

/** Whether a frame is named base_link or base_footprint. */
bool namesBase(const std::string& frame);

/** The robot's base, base_footprint before base_link, to which `frame` does not move; empty when
 *  there is none. */
std::string baseOf(const FrameTree& frames, const std::string& frame);

/** Axes of the IMU in the color camera's optical frame, from /tf_static or librealsense's
 *  recorder, else by the name of an optical frame. */
std::optional<SE3> colorFromImu(const BagSurvey& survey, const ImageTopic& color,
                                const ImuTopic& imu);

}  // namespace rgbd_graphslam
