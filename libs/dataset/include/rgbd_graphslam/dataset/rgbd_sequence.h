/** What a recorded sequence consists of, whatever its files look like. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** An image file and when it was taken. */
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
struct RgbdSequence {
    std::string folder;
    std::vector<ListedImage> color, depth;
    /** Depth readings of this value are none, as those of 0 are. */
    std::uint16_t no_reading = 0;
    /** Folder, relative to the sequence's, of 8-bit images that are named and sized as the depth
     *  images and hold the confidence in each reading: readings of 0 are none. Empty: there are
     *  none. */
    std::string confidence_folder;
    /** Poses of the color camera's optical frame. */
    Trajectory truth;
    /** Accelerometer (m/s^2) and gyroscope (rad/s), in the IMU's axes. */
    std::vector<StampedVector> acceleration, angular_velocity;
    /** x (m), y (m), heading (rad) of the robot's base. */
    std::vector<StampedVector> odometry;
    /** Readings of further sensors (laser scans, GPS), as they go into the rawlog. */
    std::vector<mrpt::obs::CObservation::Ptr> others;

    /** Calibration that came with the recording: of the color camera, and of the depth camera
     *  where depth is not registered to color. */
    std::optional<CameraSetup> camera, depth_camera;
    /** Depth units per meter, where the recording itself tells them. */
    std::optional<double> depth_units;
    /** What was found, chosen and left out, a line each; told at the end of the import. */
    std::vector<std::string> notes;
};

/** How orderly stamps come. */
struct StampOrder {
    /** Stamps earlier than the one before them. */
    std::size_t backwards = 0;
    /** Stamps that occurred before. */
    std::size_t repeated = 0;
};
StampOrder stampOrder(const std::vector<ListedImage>& images);

}  // namespace rgbd_graphslam
