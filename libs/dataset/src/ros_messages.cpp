#include "ros_messages.h"

namespace rgbd_graphslam::ros {
namespace {

/** No camera has more columns or rows. */
constexpr std::uint32_t most_pixels = 1 << 15;

/** Both versions' time is two 32-bit numbers; ROS 2 has no sequence number before it. */
Header readHeader(WireReader& in) {
    if (in.format() == WireFormat::Ros1) in.number<std::uint32_t>();
    const auto seconds = in.number<std::uint32_t>();
    const auto nanoseconds = in.number<std::uint32_t>();
    return {seconds + 1e-9 * nanoseconds, in.text()};
}

Eigen::Vector3d readVector(WireReader& in) {
    Eigen::Vector3d vector;
    for (double& value : vector) value = in.number<double>();
    return vector;
}

Eigen::Quaterniond readQuaternion(WireReader& in) {
    const Eigen::Vector3d xyz = readVector(in);
    return {in.number<double>(), xyz.x(), xyz.y(), xyz.z()};
}

SE3 readRigidMotion(WireReader& in) {
    const Eigen::Vector3d translation = readVector(in);
    return {readQuaternion(in), translation};
}

/** The first of nine numbers. */
double readCovariance(WireReader& in) {
    const double first = in.number<double>();
    for (int i = 1; i < 9; ++i) in.number<double>();
    return first;
}

template <class Number>
std::vector<Number> readSequence(WireReader& in) {
    std::vector<Number> values(in.lengthOfSequence<Number>());
    for (Number& value : values) value = in.number<Number>();
    return values;
}

}  // namespace

Image readImage(WireReader in) {
    Image image;
    image.header = readHeader(in);
    image.height = in.number<std::uint32_t>();
    image.width = in.number<std::uint32_t>();
    image.encoding = in.text();
    image.is_bigendian = in.number<std::uint8_t>() != 0;
    image.step = in.number<std::uint32_t>();
    image.data = in.data();
    if (image.width > most_pixels || image.height > most_pixels) {
        throw std::out_of_range("an impossible size");
    }
    return image;
}

CompressedImage readCompressedImage(WireReader in) {
    CompressedImage image;
    image.header = readHeader(in);
    image.format = in.text();
    image.data = in.data();
    return image;
}

CameraInfo readCameraInfo(WireReader in) {
    CameraInfo info;
    info.header = readHeader(in);
    info.height = in.number<std::uint32_t>();
    info.width = in.number<std::uint32_t>();
    info.distortion_model = in.text();
    info.D = readSequence<double>(in);
    for (double& value : info.K) value = in.number<double>();
    for (int i = 0; i < 9; ++i) in.number<double>();  // rectification
    for (double& value : info.P) value = in.number<double>();
    return info;
}

Imu readImu(WireReader in) {
    Imu imu;
    imu.header = readHeader(in);
    readQuaternion(in);  // orientation
    readCovariance(in);
    imu.angular_velocity = readVector(in);
    imu.angular_velocity_covariance = readCovariance(in);
    imu.linear_acceleration = readVector(in);
    imu.linear_acceleration_covariance = readCovariance(in);
    return imu;
}

std::vector<Transform> readTransforms(WireReader in) {
    std::vector<Transform> transforms;
    const auto count = in.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        Transform transform;
        transform.header = readHeader(in);
        transform.child = in.text();
        transform.T_parent_child = readRigidMotion(in);
        transforms.push_back(transform);
    }
    return transforms;
}

Odometry readOdometry(WireReader in) {
    Odometry odometry;
    odometry.header = readHeader(in);
    odometry.child = in.text();
    const Eigen::Vector3d position = readVector(in);
    odometry.T_parent_child = {readQuaternion(in), position};
    return odometry;
}

LaserScan readLaserScan(WireReader in) {
    LaserScan scan;
    scan.header = readHeader(in);
    for (float* value : {&scan.angle_min, &scan.angle_max, &scan.angle_increment}) {
        *value = in.number<float>();
    }
    in.number<float>();  // time between readings
    in.number<float>();  // time between scans
    scan.range_min = in.number<float>();
    scan.range_max = in.number<float>();
    scan.ranges = readSequence<float>(in);
    return scan;
}

NavSatFix readNavSatFix(WireReader in) {
    NavSatFix fix;
    fix.header = readHeader(in);
    fix.status = in.number<std::int8_t>();
    in.number<std::uint16_t>();  // services
    fix.latitude_deg = in.number<double>();
    fix.longitude_deg = in.number<double>();
    fix.altitude_m = in.number<double>();
    Eigen::Matrix3d covariance_m2;
    for (int i = 0; i < 9; ++i) covariance_m2(i / 3, i % 3) = in.number<double>();
    const bool is_known = in.number<std::uint8_t>() != 0;
    if (is_known && covariance_m2.allFinite()) fix.covariance_m2 = covariance_m2;
    return fix;
}

SE3 readPlainTransform(WireReader in) {
    return readRigidMotion(in);
}

SE3 readExtrinsics(WireReader in) {
    constexpr std::size_t without_header = 12 * sizeof(double);
    if (in.left() > without_header + 7) readHeader(in);
    SE3 T;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) T.R(row, column) = in.number<double>();
    }
    T.t = readVector(in);
    T.R = orthonormalized(T.R);
    return T;
}

float readFloat(WireReader in) {
    return in.number<float>();
}

}  // namespace rgbd_graphslam::ros
