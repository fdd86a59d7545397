/** RGB-D frames as MRPT observations. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/rawlog_info.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/rig.h"

namespace rgbd_graphslam {

/** Sensor labels of what this project writes. */
inline constexpr const char* rgbd_label = "RGBD";
inline constexpr const char* imu_label = "IMU";
inline constexpr const char* odometry_label = "ODOMETRY";
inline constexpr const char* ground_truth_label = "GROUND_TRUTH";

/** The frame in our terms. Depth of a StereoFrame is matched densely, which takes its time. Depth
 * that another camera took, by the observation's two calibrations and their relative pose, is
 * registered to color. Other pixels are shared with the observation,
 * which `owner` keeps alive; images stored outside the rawlog are loaded; the gray image is made
 * here; a confidence image of the color image's size is the mask, under which depth is removed.
 * \throws Error naming the stamp when color or depth is absent or unreadable, of different
 * size without two calibrations that say why, when the two calibrations cannot be right, when
 *          ranges are not depths along the optical axis, or as cameraOf() */
RgbdImage toRgbdImage(const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

/** The same for tracking: of a StereoFrame, the pair without depth. */
RgbdImage toTrackingImage(const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

/** The same as toRgbdImage() without a gray image that is made: there is one only where the camera
 *  is gray, and then no color image. Depth under the mask is kept. */
RgbdImage colorAndDepth(const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

/** Calibration of the color camera. One made for images an exact number of times as large or small
 *  as the observation's is resized, which is said once.
 *  \throws Error naming the stamp when it is none, or of a lens whose distortion cannot be undone
 */
Intrinsics cameraOf(const mrpt::obs::CObservation3DRangeScan& observation);

/** Pose of the color camera's optical frame on the robot's base. */
SE3 cameraOnRobot(const mrpt::obs::CObservation3DRangeScan& observation);

/** The camera of an observation with its sensor's label and its pose on the robot.
 *  \throws Error as cameraOf() */
RigCamera rigCameraOf(const mrpt::obs::CObservation3DRangeScan& observation);

/** An observation with calibration and pose, without images. \param stamp_s of the color image */
mrpt::obs::CObservation3DRangeScan::Ptr makeRgbdObservation(const CameraSetup& setup,
                                                            double stamp_s);

/** An observation of images in memory. \param color CV_8UC3, BGR, shared; \param depth CV_16UC1 in
 *  units of the setup, registered to color, copied; 0 = no reading */
mrpt::obs::CObservation3DRangeScan::Ptr makeRgbdObservation(const CameraSetup& setup,
                                                            double stamp_s, const cv::Mat& color,
                                                            const cv::Mat& depth);

/** Copies depth into an observation.
 *  \param depth CV_16UC1 in units of the setup the observation was made with */
void setDepth(mrpt::obs::CObservation3DRangeScan& observation, const cv::Mat& depth);

/** Shares a color image (CV_8UC3, BGR) with an observation. */
void setColor(mrpt::obs::CObservation3DRangeScan& observation, const cv::Mat& color);

/** Stores which pixels are to be ignored, as the observation's confidence image.
 *  \param mask CV_8UC1 of the images' size, 0 = ignored */
void setMask(mrpt::obs::CObservation3DRangeScan& observation, const cv::Mat& mask);

}  // namespace rgbd_graphslam
