#include <mrpt/maps/CSimplePointsMap.h>

#include <cstring>
#include <sstream>
#include <vector>

#include "file_bytes.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "the files written here are little-endian");

constexpr std::size_t ply_record = 15, pcd_record = 16;

std::string plyHeader(std::size_t count) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
           "\nproperty float x\nproperty float y\nproperty float z\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

std::string pcdHeader(std::size_t count) {
    const std::string number = std::to_string(count);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 "
           "4\n"
           "TYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " +
           number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number + "\nDATA binary\n";
}

/** Header, then one record a point. */
template <class WriteColor>
std::string pointBytes(const std::string& header, std::size_t record, const PointMap& points,
                       WriteColor color) {
    std::string bytes = header;
    bytes.resize(header.size() + record * points.size());
    char* at = bytes.data() + header.size();
    for (const MapPoint& point : points) {
        std::memcpy(at, point.position.data(), 12);
        color(at + 12, point.rgb);
        at += record;
    }
    return bytes;
}

}  // namespace

void savePly(const std::string& path, const PointMap& points) {
    const auto color = [](char* at, const auto& rgb) { std::memcpy(at, rgb.data(), 3); };
    const std::string bytes = pointBytes(plyHeader(points.size()), ply_record, points, color);
    writeBytes(path, bytes.data(), bytes.size());
}

void savePcd(const std::string& path, const PointMap& points) {
    const auto color = [](char* at, const auto& rgb) {
        const std::uint32_t packed = rgb[0] << 16 | rgb[1] << 8 | rgb[2];
        std::memcpy(at, &packed, 4);
    };
    const std::string bytes = pointBytes(pcdHeader(points.size()), pcd_record, points, color);
    writeBytes(path, bytes.data(), bytes.size());
}

void saveMetricMap(const std::string& path, const PointMap& points) {
    mrpt::maps::CSimplePointsMap map;
    map.reserve(points.size());
    for (const auto& [p, rgb] : points) map.insertPointFast(p.x(), p.y(), p.z());
    map.mark_as_modified();
    saveMrptObject(path, map);
}

PointMap loadPly(const std::string& path) {
    const std::string bytes = readBytes(path);
    const auto refuse = [&](const std::string& why) {
        throw Error("'" + path + "' " + why, "write the map again with rgbd-map");
    };
    const std::string vertex = "element vertex ";
    const auto at = bytes.substr(0, 1000).find(vertex);
    if (at == std::string::npos) refuse("is no PLY file");
    const std::size_t count = std::strtoull(bytes.c_str() + at + vertex.size(), nullptr, 10);
    const std::string header = plyHeader(count);
    if (bytes.compare(0, header.size(), header) != 0) refuse("is a PLY file of another layout");
    if ((bytes.size() - header.size()) / ply_record != count) refuse("is cut off");
    PointMap points(count);
    const char* record = bytes.data() + header.size();
    for (MapPoint& point : points) {
        std::memcpy(point.position.data(), record, 12);
        std::memcpy(point.rgb.data(), record + 12, 3);
        record += ply_record;
    }
    return points;
}

}  // namespace rgbd_graphslam
