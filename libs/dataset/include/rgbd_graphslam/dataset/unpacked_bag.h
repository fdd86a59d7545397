/** RGB-D recordings in ROS 1 bags. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/temporary_folder.h"

namespace rgbd_graphslam {

/** Whether a path names a file with the ending .bag. */
bool isBag(const std::string& path);

/** What an RGB-D camera left in a ROS 1 bag, unpacked into a temporary folder in TUM's layout that
 *  goes when this object goes: colour (the first topic of 8-bit images), depth (the first of 32-bit
 *  floats in metres or 16-bit integers in mm, written as 1/5000 m), accelerometer and gyroscope
 *  (sensor_msgs/Imu), and the true path of the colour camera from /tf, where a frame above it
 *  moves. The colour camera's calibration becomes camera.ini, unless the bag's name tells one of
 *  TUM's cameras. Stamps are those of the messages' headers. */
class UnpackedBag {
  public:
    /** \param scratch folder to unpack in; needs room for all images as PNG
     *  \throws Error when the bag is damaged, holds no colour or depth image, or images of a kind
     *          that is not understood */
    UnpackedBag(const std::string& bag, const std::string& scratch);

    /** Named as the bag is. */
    const std::string& sequenceFolder() const { return folder_; }

  private:
    TemporaryFolder scratch_;
    std::string folder_;
};

}  // namespace rgbd_graphslam
