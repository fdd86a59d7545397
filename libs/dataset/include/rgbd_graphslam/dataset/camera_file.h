/** Calibrations: of the TUM benchmark's cameras, and in files. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** Everything about a camera that its images do not tell. */
struct CameraSetup {
    /** "fr1", "fr2", "fr3", "ros" or the file it came from. */
    std::string name = "ros";
    Intrinsics camera;
    /** Depth of one unit is depth_scale / depth_units meters. */
    double depth_units = 5000;
    /** Nobody stated depth_units: it is the default. */
    bool depth_units_assumed = false;
    double depth_scale = 1;
    /** Where the sensor (MRPT's axes: x forward, y left, z up) sits on the robot's base; identity
     *  for a camera held by hand. */
    SE3 T_base_sensor;
    /** Axes of accelerometer and gyroscope in the sensor's; see kinectImuAxes. */
    SE3 T_sensor_imu;

    CameraSetup();
    double depthUnitInMetres() const { return depth_scale / depth_units; }
};

/** Axes of the Kinect's accelerometer (x left, y up, z forward) in MRPT's sensor frame. Not stated
 *  by the TUM benchmark; found by fitting fr1/xyz's accelerometer to gravity in its ground truth,
 *  which gives these axes within 5 degrees. */
SE3 kinectImuAxes();

/** A calibration by name: the TUM benchmark's "fr1", "fr2", "fr3" (from its page on file formats)
 *  or "ros", the default of the Kinect's ROS driver.
 *  \return nothing for another name */
std::optional<CameraSetup> cameraByName(const std::string& name);

/** The calibration that a TUM sequence's folder name speaks of, e.g. "freiburg2" or "fr2". */
std::optional<CameraSetup> cameraByFolderName(const std::string& folder);

/** What is hardly right in a calibration: a principal point more than a quarter of the image away
 *  from its center or even outside, a field of view of less than 15 or more than 150 degrees. A
 * line each; empty when the camera is plausible. */
std::vector<std::string> doubtsOf(const Intrinsics& camera);

/** \param name of the calibration, for the message
 *  \throws Error when the principal point is outside the image */
void requirePrincipalPoint(const Intrinsics& camera, const std::string& name);

/** The same camera for images of another size, where these are `factor` times as large or small as
 *  the calibration says, in both directions.
 *  \return nothing unless the factor is 1, or 2 to 8 or one half to one eighth */
std::optional<Intrinsics> resizedTo(const Intrinsics& camera, int width, int height);

/** Reads section `[CAMERA_PARAMS]` as `mrpt::img::TCamera::loadFromConfigFile` does: resolution,
 *  fx, fy, cx, cy (px), distortion_model, dist. `dist` without `distortion_model` counts as
 *  plumb_bob (MRPT would ignore it silently) and may be [k1 k2 p1 p2]; eight coefficients are the
 *  rational model, [k1 k2 k3 k4] with kannala_brandt the fisheye. Further keys, all optional:
 * depth_units (a meter), depth_scale, sensor_pose and imu_pose as `[x y z yaw pitch roll]` in m and
 * degrees. \throws Error naming file and key for a missing, unknown or repeated key (also as `Fx`
 * beside `fx`, which MRPT takes for the same), a value out of range, a principal point outside the
 *          image, or another lens model */
CameraSetup readCameraFile(const std::string& path);

/** The text that readCameraFile reads back to the same numbers. */
std::string toIniText(const CameraSetup& setup);

}  // namespace rgbd_graphslam
