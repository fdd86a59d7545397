#include <filesystem>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/geometry/geodetic.h"
#include "run_trajectory.h"

namespace rgbd_graphslam {
namespace {

/** A run's way on the earth. */
struct GeoWay {
    Trajectory trajectory;
    std::vector<GeodeticPlace> places;
};

GeoWay readWay(const std::string& run_folder) {
    const GeoReference reference =
        readGeoReference((std::filesystem::path(run_folder) / georeference_name).string());
    GeoWay way{readRunTrajectory(run_folder), {}};
    for (const StampedPose& pose : way.trajectory) {
        way.places.push_back(reference.place(pose.T_world_cam.t));
    }
    return way;
}

/** Longitude, latitude, height: both formats' order. */
std::string coordinates(const GeodeticPlace& place) {
    return formatted("%.9f,%.9f,%.3f", place.longitude_deg, place.latitude_deg, place.altitude_m);
}

class KmlExporter : public Exporter {
  public:
    const char* name() const override { return "kml"; }
    const char* about() const override { return "way on the earth, for Google Earth (needs GPS)"; }
    const char* fileName() const override { return "trajectory.kml"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const GeoWay way = readWay(run_folder);
        std::string text =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n<name>rgbd-slam</name>\n"
            "<Placemark>\n<name>trajectory</name>\n<LineString>\n<tessellate>1</tessellate>\n"
            "<altitudeMode>clampToGround</altitudeMode>\n<coordinates>\n";
        for (const GeodeticPlace& place : way.places) text += coordinates(place) + "\n";
        text += "</coordinates>\n</LineString>\n</Placemark>\n</Document>\n</kml>\n";
        writeTextAtomically(path, text);
        return poseCount(way.trajectory);
    }
};

class GeoJsonExporter : public Exporter {
  public:
    const char* name() const override { return "geojson"; }
    const char* about() const override { return "way on the earth, RFC 7946 (needs GPS)"; }
    const char* fileName() const override { return "trajectory.geojson"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const GeoWay way = readWay(run_folder);
        std::string line, stamps;
        for (std::size_t i = 0; i < way.places.size(); ++i) {
            line += (i ? ",\n[" : "[") + coordinates(way.places[i]) + "]";
            stamps += (i ? "," : "") + formatted("%.6f", way.trajectory[i].stamp_s);
        }
        writeTextAtomically(path,
                            "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\","
                            "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[" +
                                line + "]},\"properties\":{\"name\":\"trajectory\",\"stamps_s\":[" +
                                stamps + "]}}]}\n");
        return poseCount(way.trajectory);
    }
};

}  // namespace

std::unique_ptr<const Exporter> kmlExporter() {
    return std::make_unique<KmlExporter>();
}

std::unique_ptr<const Exporter> geoJsonExporter() {
    return std::make_unique<GeoJsonExporter>();
}

}  // namespace rgbd_graphslam
