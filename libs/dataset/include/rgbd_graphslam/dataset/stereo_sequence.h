/** Recordings of two cameras side by side. */
#pragma once
#include <mrpt/img/TCamera.h>

#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Both cameras of a stereo head, and where they and the IMU are on the robot. */
struct StereoCalibration {
    /** The file it came from. */
    std::string name;
    /** In MRPT's terms, which know fisheye lenses, too. 0x0 pixels: not stated. */
    mrpt::img::TCamera left, right;
    /** Pose of the left camera's optical frame on the robot's base. */
    SE3 T_base_left;
    /** Pose of the right camera's optical frame in the left one's. */
    SE3 T_left_right;
    SE3 T_base_imu;
};

/** The lists of a stereo recording, in file order; images are not read. */
struct StereoSequence {
    std::string folder;
    std::vector<ListedImage> left, right;
    StereoCalibration calibration;
    /** IMU, odometry, truth (of the left camera's optical frame) and notes; it has no images. */
    RgbdSequence motion;
};

/** Reads two cameras of one ini file: [CAMERA_PARAMS], the left one, and [CAMERA_PARAMS_RIGHT] as
 *  readCameraFile() does, and `baseline` (m) of [STEREO], by which the right one lies to the right.
 *  \throws Error naming file and key */
StereoCalibration readStereoCameraFile(const std::string& path);

/** Whether a folder is laid out as one of
 *  - EuRoC (also TUM-VI): mav0/cam0, cam1 with data/, data.csv and sensor.yaml, or Kalibr's
 *    dso/camchain.yaml; imu0/data.csv; state_groundtruth_estimate0/data.csv or mocap0/data.csv;
 *  - KITTI odometry: image_0 and image_1, or image_2 and image_3; calib.txt, times.txt, and
 *    poses.txt or ../../poses/NAME.txt;
 *  - left/ and right/, with left.txt and right.txt (`stamp file`) or by the names of the images,
 * and camera.ini, see readStereoCameraFile(); motion as in TUM's folders. */
bool isStereoFolder(const std::string& folder);

/** \param rate_hz frames per second where nothing has stamps
 *  \param camera_file ini file that replaces the folder's calibration; empty: none
 *  \throws Error naming file and line that do not have their form, or the calibration that is
 * missing or cannot be right */
StereoSequence readStereoFolder(const std::string& folder, double rate_hz,
                                const std::string& camera_file = {});

}  // namespace rgbd_graphslam
