#include "rgbd_graphslam/export/ros2_messages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "rgbd_graphslam/export/cdr_writer.h"

namespace rgbd_graphslam {
namespace {

/** Fields of each type, without the constants' comments. */
const std::map<std::string, std::string>& fieldsOfTypes() {
    static const std::map<std::string, std::string> fields = {
        {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
        {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
        {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
        {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
        {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
        {"geometry_msgs/Pose",
         "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
        {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
        {"geometry_msgs/Transform",
         "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
        {"geometry_msgs/TransformStamped",
         "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
        {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
        {"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
        {"nav_msgs/MapMetaData",
         "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\n"
         "uint32 height\ngeometry_msgs/Pose origin\n"},
        {"nav_msgs/OccupancyGrid",
         "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
        {"sensor_msgs/PointField",
         "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
         "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\n"
         "uint8 datatype\nuint32 count\n"},
        {"sensor_msgs/PointCloud2",
         "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
         "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\n"
         "bool is_dense\n"}};
    return fields;
}

/** Types that a type's fields name, each behind all that use it, once. */
void collectTypes(const std::string& type, std::vector<std::string>& all) {
    for (const auto& [other, fields] : fieldsOfTypes()) {
        const bool used = ("\n" + fieldsOfTypes().at(type)).find("\n" + other) != std::string::npos;
        if (!used || std::find(all.begin(), all.end(), other) != all.end()) continue;
        all.push_back(other);
        collectTypes(other, all);
    }
}

void putTime(CdrWriter& out, double stamp_s) {
    constexpr std::int64_t second = 1000000000;
    const std::int64_t ns = rosNanoseconds(stamp_s);
    out.put(static_cast<std::int32_t>(ns / second)).put(static_cast<std::uint32_t>(ns % second));
}

void putHeader(CdrWriter& out, double stamp_s, const std::string& frame) {
    putTime(out, stamp_s);
    out.putText(frame);
}

/** Of a Pose as of a Transform. */
void putPose(CdrWriter& out, const SE3& pose) {
    const Eigen::Quaterniond q = pose.quaternion();
    for (const double value : {pose.t.x(), pose.t.y(), pose.t.z(), q.x(), q.y(), q.z(), q.w()})
        out.put(value);
}

void putPoseStamped(CdrWriter& out, const StampedPose& pose, const std::string& frame) {
    putHeader(out, pose.stamp_s, frame);
    putPose(out, pose.T_world_cam);
}

void putFields(CdrWriter& out) {
    constexpr std::uint8_t float32 = 7;
    const std::vector<std::string> names = {"x", "y", "z", "rgb"};
    out.putCount(names.size());
    std::uint32_t offset = 0;
    for (const std::string& name : names) {
        out.putText(name).put(offset).put(float32).put(std::uint32_t{1});
        offset += sizeof(float);
    }
}

}  // namespace

Ros2Type ros2Type(const std::string& name) {
    const std::string separator(80, '=');
    const auto slash = name.find("/msg/");
    const std::string type = name.substr(0, slash) + name.substr(slash + 4);
    std::vector<std::string> used;
    collectTypes(type, used);
    std::string definition = fieldsOfTypes().at(type);
    for (const std::string& other : used)
        definition += separator + "\nMSG: " + other + "\n" + fieldsOfTypes().at(other);
    return {name, definition};
}

std::int64_t rosNanoseconds(double stamp_s) {
    return std::max<std::int64_t>(0, 1000 * std::llround(1e6 * stamp_s));
}

std::string tfMessage(const StampedPose& pose, const std::string& frame, const std::string& child) {
    CdrWriter out;
    out.putCount(1);
    putHeader(out, pose.stamp_s, frame);
    out.putText(child);
    putPose(out, pose.T_world_cam);
    return out.take();
}

std::string poseMessage(const StampedPose& pose, const std::string& frame) {
    CdrWriter out;
    putPoseStamped(out, pose, frame);
    return out.take();
}

std::string pathMessage(const Trajectory& poses, const std::string& frame) {
    CdrWriter out;
    putHeader(out, poses.empty() ? 0 : poses.front().stamp_s, frame);
    out.putCount(poses.size());
    for (const StampedPose& pose : poses) putPoseStamped(out, pose, frame);
    return out.take();
}

std::string pointCloudMessage(const PointMap& points, double stamp_s, const std::string& frame) {
    constexpr std::uint32_t point_bytes = 16;
    CdrWriter out;
    out.reserve(points.size() * point_bytes + 256);
    putHeader(out, stamp_s, frame);
    const auto count = static_cast<std::uint32_t>(points.size());
    out.put(std::uint32_t{1}).put(count);
    putFields(out);
    out.put(std::uint8_t{0}).put(point_bytes).put(point_bytes * count);
    out.putCount(points.size() * point_bytes);
    for (const MapPoint& point : points) {
        ByteWriter bytes;
        for (int i = 0; i < 3; ++i) bytes.put(point.position[i]);
        for (int i = 2; i >= 0; --i) bytes.put(point.rgb[static_cast<std::size_t>(i)]);
        bytes.put<std::uint8_t>(0);
        out.putBytes(bytes.bytes());
    }
    out.put(std::uint8_t{1});
    return out.take();
}

std::string gridMessage(const GridMap& grid, double stamp_s, const std::string& frame) {
    CdrWriter out;
    putHeader(out, stamp_s, frame);
    putTime(out, stamp_s);
    out.put(static_cast<float>(grid.cell_m))
        .put(static_cast<std::uint32_t>(grid.cells.cols))
        .put(static_cast<std::uint32_t>(grid.cells.rows));
    putPose(out, SE3(Eigen::Matrix3d::Identity(), {grid.x_m, grid.y_m, 0}));
    out.putCount(grid.cells.total());
    for (int row = 0; row < grid.cells.rows; ++row) {
        out.putBytes({reinterpret_cast<const char*>(grid.cells[row]),
                      static_cast<std::size_t>(grid.cells.cols)});
    }
    return out.take();
}

}  // namespace rgbd_graphslam
