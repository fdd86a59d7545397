#include <mrpt/maps/CSimplePointsMap.h>

#include <cstring>
#include <sstream>
#include <vector>

#include "file_bytes.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "the files written here are little-endian");

constexpr std::size_t pcd_record = 16;  // bytes a point

std::string pcdHeader(std::size_t count) {
    const std::string number = std::to_string(count);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 "
           "4\n"
           "TYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " +
           number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number + "\nDATA binary\n";
}

}  // namespace

void savePly(const std::string& path, const PointMap& points) {
    PlyModel model;
    model.vertices.reserve(points.size());
    model.colors.reserve(points.size());
    for (const auto& [position, rgb] : points) {
        model.vertices.push_back(position);
        model.colors.push_back(rgb);
    }
    writePly(path, model);
}

void savePcd(const std::string& path, const PointMap& points) {
    const std::string header = pcdHeader(points.size());
    std::string bytes = header;
    bytes.resize(header.size() + pcd_record * points.size());
    char* at = bytes.data() + header.size();
    for (const auto& [position, rgb] : points) {
        const std::uint32_t packed = rgb[0] << 16 | rgb[1] << 8 | rgb[2];
        std::memcpy(at, position.data(), 12);
        std::memcpy(at + 12, &packed, 4);
        at += pcd_record;
    }
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
    const PlyModel model = readPly(path);
    if (model.colors.size() != model.vertices.size()) {
        throw Error("'" + path + "' has no colors", "write the map again with rgbd-map");
    }
    PointMap points(model.vertices.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {model.vertices[i], model.colors[i]};
    }
    return points;
}

}  // namespace rgbd_graphslam
