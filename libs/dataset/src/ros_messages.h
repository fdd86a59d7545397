/** The ROS 1 messages that an RGB-D camera leaves in a bag; each knows its wire format. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam::ros {

struct Header {
    double stamp_s = 0;
    std::string frame;
};

/** sensor_msgs/Image */
struct Image {
    Header header;
    std::uint32_t height = 0, width = 0, step = 0;  // rows, columns, bytes a row
    std::string encoding, data;
    bool is_bigendian = false;
};

/** sensor_msgs/CameraInfo */
struct CameraInfo {
    Header header;
    std::uint32_t height = 0, width = 0;
    std::string distortion_model;
    std::vector<double> D;
    std::array<double, 9> K{};
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

/** \param bytes a message as serialised \throws std::out_of_range when they end too early */
Image readImage(const std::string& bytes);
CameraInfo readCameraInfo(const std::string& bytes);
Imu readImu(const std::string& bytes);
/** Of tf/tfMessage and tf2_msgs/TFMessage. */
std::vector<Transform> readTransforms(const std::string& bytes);

}  // namespace rgbd_graphslam::ros
