/** RGB-D recordings in ROS bags. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/temporary_folder.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Whether a path names a ROS bag: a file .bag (also .bag.active), .db3 or .mcap, the last two also
 *  with .zstd behind, or the folder of a ROS 2 bag. */
bool isBag(const std::string& path);

/** Which topics of a bag to take. */
struct BagOptions {
    /** Image topics to take; empty: the best ones, see UnpackedBag. */
    std::string color_topic, depth_topic;
    /** Take the other sensors alone. */
    bool no_camera = false;
};

/** What an RGB-D camera and a robot left in a ROS bag. Images go to a temporary folder that goes
 *  when this object goes. Recordings of ROS 1, ROS 2 and librealsense's recorder are understood:
 *
 *  - color: sensor_msgs/Image or CompressedImage (JPEG, PNG). Color is preferred to gray, visible
 *    light to infrared, raw pixels to compressed ones, the first recorded to others.
 *  - depth: 16-bit integers in mm (or librealsense's depth unit), 32-bit floats in m, both also
 *    packed by compressed_depth_image_transport. Depth registered to color is preferred; raw depth
 *    sets RgbdSequence::depth_camera where the calibrations of both cameras and their poses to each
 *    other are recorded.
 *  - calibrations: sensor_msgs/CameraInfo, unless the bag's name tells one of TUM's cameras; poses
 *    on the robot from /tf_static.
 *  - ground truth: /tf, where the camera moves in a frame named after a world, a map or a motion
 *    capture system. Odometry: nav_msgs/Odometry, else /tf below a frame named odom.
 *  - accelerometer and gyroscope: sensor_msgs/Imu, one topic or two. LaserScan, NavSatFix.
 *
 *  Stamps are those of the messages' headers. All else is listed in the sequence's notes. */
class UnpackedBag {
  public:
    /** \param scratch folder to unpack in; needs room for all images
     *  \throws Error when the bag is damaged, or lacks color or depth images of a kind that is
     *          understood (it lists the topics then) */
    UnpackedBag(const std::string& bag, const std::string& scratch, const BagOptions& options = {});

    const RgbdSequence& sequence() const { return sequence_; }

  private:
    TemporaryFolder scratch_;
    RgbdSequence sequence_;
};

}  // namespace rgbd_graphslam
