/** Folders in the layout of the TUM RGB-D benchmark. */
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** One line of rgb.txt or depth.txt. */
struct ListedImage {
    double stamp_s = 0;
    /** Relative to the sequence's folder. */
    std::string file;
};

/** One line of a sensor's text file. */
struct StampedVector {
    double stamp_s = 0;
    Eigen::Vector3d value;
};

/** The lists of a sequence, in file order; images are not read. */
struct TumSequence {
    std::string folder;
    std::vector<ListedImage> color, depth;
    Trajectory truth;
    /** accelerometer.txt (m/s^2), gyroscope.txt (rad/s): in the IMU's axes. */
    std::vector<StampedVector> acceleration, angular_velocity;
    /** odometry.txt: x (m), y (m), heading (rad) of the robot's base. */
    std::vector<StampedVector> odometry;
};

/** Reads rgb.txt and depth.txt (`stamp file`), and where present groundtruth.txt (`stamp tx ty tz
 * qx qy qz qw`), accelerometer.txt (`stamp ax ay az`), gyroscope.txt (`stamp wx wy wz`) and
 *  odometry.txt (`stamp x y theta`).
 *  \throws Error when the folder or a list is missing or empty, or naming file and line that do not
 *          have this form */
TumSequence readTumSequence(const std::string& folder);

/** How orderly stamps come. */
struct StampOrder {
    /** Stamps earlier than the one before them. */
    std::size_t backwards = 0;
    /** Stamps that occurred before. */
    std::size_t repeated = 0;
};
StampOrder stampOrder(const std::vector<ListedImage>& images);

}  // namespace rgbd_graphslam
