#include "ros_messages.h"

#include "wire_reader.h"

namespace rgbd_graphslam::ros {
namespace {

constexpr std::size_t rest_of_covariance = 8 * sizeof(double);

Header readHeader(WireReader& in) {
    in.number<std::uint32_t>();  // sequence number
    const auto seconds = in.number<std::uint32_t>();
    const auto nanoseconds = in.number<std::uint32_t>();
    return {seconds + 1e-9 * nanoseconds, in.text()};
}

Eigen::Vector3d readVector(WireReader& in) {
    Eigen::Vector3d vector;
    for (double& value : vector) value = in.number<double>();
    return vector;
}

}  // namespace

Image readImage(const std::string& bytes) {
    WireReader in(bytes);
    Image image;
    image.header = readHeader(in);
    image.height = in.number<std::uint32_t>();
    image.width = in.number<std::uint32_t>();
    image.encoding = in.text();
    image.is_bigendian = in.number<std::uint8_t>() != 0;
    image.step = in.number<std::uint32_t>();
    image.data = in.text();
    return image;
}

CameraInfo readCameraInfo(const std::string& bytes) {
    WireReader in(bytes);
    CameraInfo info;
    info.header = readHeader(in);
    info.height = in.number<std::uint32_t>();
    info.width = in.number<std::uint32_t>();
    info.distortion_model = in.text();
    const auto coefficients = in.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < coefficients; ++i) info.D.push_back(in.number<double>());
    for (double& value : info.K) value = in.number<double>();
    return info;
}

Imu readImu(const std::string& bytes) {
    WireReader in(bytes);
    Imu imu;
    imu.header = readHeader(in);
    in.skip(4 * sizeof(double) + 9 * sizeof(double));  // orientation
    imu.angular_velocity = readVector(in);
    imu.angular_velocity_covariance = in.number<double>();
    in.skip(rest_of_covariance);
    imu.linear_acceleration = readVector(in);
    imu.linear_acceleration_covariance = in.number<double>();
    return imu;
}

std::vector<Transform> readTransforms(const std::string& bytes) {
    WireReader in(bytes);
    std::vector<Transform> transforms;
    const auto count = in.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        Transform transform;
        transform.header = readHeader(in);
        transform.child = in.text();
        const Eigen::Vector3d t = readVector(in), xyz = readVector(in);
        const double w = in.number<double>();
        transform.T_parent_child = {Eigen::Quaterniond(w, xyz.x(), xyz.y(), xyz.z()), t};
        transforms.push_back(transform);
    }
    return transforms;
}

}  // namespace rgbd_graphslam::ros
