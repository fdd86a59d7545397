/** The ROS messages of an RGB-D recording. Each is described once, for ROS 1 and ROS 2. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"
#include "wire_reader.h"

namespace rgbd_graphslam::ros {

struct Header {
    double stamp_s = 0;
    std::string frame;
};

/** sensor_msgs/Image; the pixels belong to the message. */
struct Image {
    Header header;
    std::uint32_t height = 0, width = 0, step = 0;  // rows, columns, bytes per row
    std::string encoding;
    bool is_bigendian = false;
    std::string_view data;
};

/** sensor_msgs/CompressedImage; the bytes belong to the message. */
struct CompressedImage {
    Header header;
    std::string format;
    std::string_view data;
};

/** sensor_msgs/CameraInfo */
struct CameraInfo {
    Header header;
    std::uint32_t height = 0, width = 0;
    std::string distortion_model;
    std::vector<double> D;
    std::array<double, 9> K{};
    /** Of the rectified image, 3 x 4. */
    std::array<double, 12> P{};
};

/** sensor_msgs/Imu; -1 as the first covariance stands for a sensor that is not there. */
struct Imu {
    Header header;
    Eigen::Vector3d angular_velocity, linear_acceleration;
    double angular_velocity_covariance = 0, linear_acceleration_covariance = 0;
};

/** geometry_msgs/TransformStamped: a frame's pose in its parent, the header's frame. */
struct Transform {
    Header header;
    std::string child;
    SE3 T_parent_child;
};

/** nav_msgs/Odometry, without velocities. */
struct Odometry {
    Header header;
    std::string child;
    SE3 T_parent_child;
};

/** sensor_msgs/LaserScan, without intensities. */
struct LaserScan {
    Header header;
    float angle_min = 0, angle_max = 0, angle_increment = 0, range_min = 0, range_max = 0;
    std::vector<float> ranges;
};

/** sensor_msgs/NavSatFix, without covariance. */
struct NavSatFix {
    Header header;
    /** -1 no fix, 0 fix, 1 satellite-based, 2 ground-based augmentation. */
    int status = 0;
    double latitude_deg = 0, longitude_deg = 0, altitude_m = 0;
    /** East, north, up, m^2; zero where the driver does not know it. */
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
};

/** Each reads a message as serialized, from behind the encapsulation.
 *  \throws std::out_of_range when the bytes end too early */
Image readImage(WireReader in);
CompressedImage readCompressedImage(WireReader in);
CameraInfo readCameraInfo(WireReader in);
Imu readImu(WireReader in);
/** Of tf/tfMessage and tf2_msgs/TFMessage. */
std::vector<Transform> readTransforms(WireReader in);
Odometry readOdometry(WireReader in);
LaserScan readLaserScan(WireReader in);
NavSatFix readNavSatFix(WireReader in);
/** geometry_msgs/Transform: maps points as its quaternion and translation say. */
SE3 readPlainTransform(WireReader in);
/** realsense2_camera/Extrinsics, and realsense2_camera_msgs/Extrinsics, which has no header. */
SE3 readExtrinsics(WireReader in);
/** std_msgs/Float32 */
float readFloat(WireReader in);

}  // namespace rgbd_graphslam::ros
