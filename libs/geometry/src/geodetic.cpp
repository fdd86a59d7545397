#include "rgbd_graphslam/geometry/geodetic.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

// WGS 84: semi-major axis, flattening.
constexpr double a = 6378137.0, f = 1 / 298.257223563;
constexpr double e2 = f * (2 - f), b = a * (1 - f);
constexpr double degree = M_PI / 180;

/** Value of `key: number`; nothing where there is none. */
std::optional<double> numberOf(const std::string& text, const std::string& key) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto colon = line.find(':');
        if (colon == std::string::npos || line.substr(0, colon) != key) continue;
        double value = 0;
        if (std::istringstream(line.substr(colon + 1)) >> value) return value;
    }
    return std::nullopt;
}

}  // namespace

Eigen::Vector3d earthCentered(const GeodeticPlace& place) {
    const double lat = place.latitude_deg * degree, lon = place.longitude_deg * degree;
    const double normal_m = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
    const double h = place.altitude_m;
    return {(normal_m + h) * std::cos(lat) * std::cos(lon),
            (normal_m + h) * std::cos(lat) * std::sin(lon),
            (normal_m * (1 - e2) + h) * std::sin(lat)};
}

GeodeticPlace geodeticPlace(const Eigen::Vector3d& p) {
    constexpr double second_e2 = (a * a - b * b) / (b * b);
    const double from_axis_m = p.head<2>().norm();
    double reduced = std::atan2(p.z() * a, from_axis_m * b), lat = 0;
    for (int i = 0; i < 5; ++i) {
        lat = std::atan2(p.z() + second_e2 * b * std::pow(std::sin(reduced), 3),
                         from_axis_m - e2 * a * std::pow(std::cos(reduced), 3));
        reduced = std::atan2(b * std::sin(lat), a * std::cos(lat));
    }
    const double sine = std::sin(lat), cosine = std::cos(lat);
    const double normal_m = a / std::sqrt(1 - e2 * sine * sine);
    const double altitude_m = from_axis_m * cosine + p.z() * sine - a * a / normal_m;
    return {lat / degree, std::atan2(p.y(), p.x()) / degree, altitude_m};
}

LocalTangentPlane::LocalTangentPlane(const GeodeticPlace& origin) : origin_(origin) {
    const double lat = origin.latitude_deg * degree, lon = origin.longitude_deg * degree;
    T_enu_earth_.R << -std::sin(lon), std::cos(lon), 0, -std::sin(lat) * std::cos(lon),
        -std::sin(lat) * std::sin(lon), std::cos(lat), std::cos(lat) * std::cos(lon),
        std::cos(lat) * std::sin(lon), std::sin(lat);
    T_enu_earth_.t = -(T_enu_earth_.R * earthCentered(origin));
}

Eigen::Vector3d LocalTangentPlane::toEnu(const GeodeticPlace& place) const {
    return T_enu_earth_ * earthCentered(place);
}

GeodeticPlace LocalTangentPlane::toGeodetic(const Eigen::Vector3d& enu) const {
    return geodeticPlace(T_enu_earth_.inverse() * enu);
}

GeodeticPlace GeoReference::place(const Eigen::Vector3d& world) const {
    return LocalTangentPlane(origin).toGeodetic(rotationExp({0, 0, yaw_rad}) * world);
}

std::string toYaml(const GeoReference& reference) {
    return formatted(
        "# Where the map's world lies on the earth (WGS 84).\n"
        "latitude_deg: %.10f\nlongitude_deg: %.10f\naltitude_m: %.4f\n"
        "# From east to the map's x axis, counterclockwise.\n"
        "yaw_deg: %.6f\n",
        reference.origin.latitude_deg, reference.origin.longitude_deg, reference.origin.altitude_m,
        reference.yaw_rad / degree);
}

GeoReference readGeoReference(const std::string& path) {
    std::ifstream in(path);
    if (!in) {
        throw Error("there is no '" + path + "'",
                    "run rgbd-slam on a recording with GPS (CObservationGPS)");
    }
    std::stringstream text;
    text << in.rdbuf();
    const auto lat = numberOf(text.str(), "latitude_deg"),
               lon = numberOf(text.str(), "longitude_deg"),
               alt = numberOf(text.str(), "altitude_m"), yaw = numberOf(text.str(), "yaw_deg");
    if (!lat || !lon || !alt || !yaw || std::abs(*lat) > 90 || std::abs(*lon) > 360) {
        throw Error("'" + path + "' lacks latitude_deg, longitude_deg, altitude_m or yaw_deg",
                    "run rgbd-slam again");
    }
    return {{*lat, *lon, *alt}, *yaw * degree};
}

}  // namespace rgbd_graphslam
