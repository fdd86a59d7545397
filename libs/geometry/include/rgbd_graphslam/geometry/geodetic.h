/** Places on the earth. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** WGS 84, height above the ellipsoid. */
struct GeodeticPlace {
    double latitude_deg = 0, longitude_deg = 0, altitude_m = 0;
};

/** In the frame of the earth's center (ECEF), m. */
Eigen::Vector3d earthCentered(const GeodeticPlace& place);
/** Inverse of earthCentered (Bowring's iteration), to a millimeter up to any height flown. */
GeodeticPlace geodeticPlace(const Eigen::Vector3d& earth_centered);

/** East, north and up of an origin, m. */
class LocalTangentPlane {
  public:
    explicit LocalTangentPlane(const GeodeticPlace& origin);

    const GeodeticPlace& origin() const { return origin_; }
    Eigen::Vector3d toEnu(const GeodeticPlace& place) const;
    GeodeticPlace toGeodetic(const Eigen::Vector3d& enu) const;

  private:
    GeodeticPlace origin_;
    SE3 T_enu_earth_;
};

/** Where a map lies on the earth: its world's origin, and the angle from east to its x axis,
 *  counterclockwise. */
struct GeoReference {
    GeodeticPlace origin;
    double yaw_rad = 0;

    /** \param world a point in the map, m */
    GeodeticPlace place(const Eigen::Vector3d& world) const;
};

/** Name of the file in an output folder. */
inline constexpr const char* georeference_name = "georeference.yaml";

std::string toYaml(const GeoReference& reference);
/** \throws Error naming the file when it is missing or something is amiss in it */
GeoReference readGeoReference(const std::string& path);

}  // namespace rgbd_graphslam
