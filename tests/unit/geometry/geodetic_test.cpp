/** Places on the earth. */
#include "rgbd_graphslam/geometry/geodetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../../support/random_inputs.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

TEST(Geodetic, knownPlaces) {
    // NGA's definition of WGS 84: axes of the ellipsoid.
    EXPECT_LT((earthCentered({0, 0, 0}) - Eigen::Vector3d(6378137, 0, 0)).norm(), 1e-6);
    EXPECT_LT((earthCentered({90, 0, 0}) - Eigen::Vector3d(0, 0, 6356752.314245)).norm(), 1e-4);
    EXPECT_LT((earthCentered({0, 90, 100}) - Eigen::Vector3d(0, 6378237, 0)).norm(), 1e-6);
}

TEST(Geodetic, thereAndBack) {
    RandomInputs random(1);
    for (int i = 0; i < 200; ++i) {
        const GeodeticPlace place{random.uniform(-89.9, 89.9), random.uniform(-179.9, 179.9),
                                  random.uniform(-400, 9000)};
        const GeodeticPlace back = geodeticPlace(earthCentered(place));
        EXPECT_NEAR(back.latitude_deg, place.latitude_deg, 1e-10);
        EXPECT_NEAR(back.longitude_deg, place.longitude_deg, 1e-10);
        EXPECT_NEAR(back.altitude_m, place.altitude_m, 1e-5);
    }
}

TEST(LocalTangentPlane, axesPointEastNorthAndUp) {
    const LocalTangentPlane plane({48, 11, 500});
    EXPECT_LT(plane.toEnu({48, 11, 510}).head<2>().norm(), 1e-6);
    EXPECT_NEAR(plane.toEnu({48, 11, 510}).z(), 10, 1e-6);
    const Eigen::Vector3d east = plane.toEnu({48, 11.001, 500}),
                          north = plane.toEnu({48.001, 11, 500});
    EXPECT_NEAR(east.x(), 74.6, 0.1);
    EXPECT_NEAR(east.y(), 0, 0.01);
    EXPECT_NEAR(north.y(), 111.2, 0.1);
    EXPECT_NEAR(north.x(), 0, 0.01);
}

TEST(GeoReference, placesPointsOfTheMapAndSurvivesItsFile) {
    const GeoReference reference{{48, 11, 500}, M_PI / 2};  // the map's x axis points north
    const TestFolder folder;
    std::ofstream(folder / "georeference.yaml") << toYaml(reference);
    const GeoReference read = readGeoReference(folder / "georeference.yaml");
    EXPECT_NEAR(read.yaw_rad, reference.yaw_rad, 1e-7);
    const GeodeticPlace ahead = read.place({100, 0, 2});
    EXPECT_NEAR(ahead.latitude_deg, 48 + 100 / 111200.0, 2e-6);
    EXPECT_NEAR(ahead.longitude_deg, 11, 1e-7);
    EXPECT_NEAR(ahead.altitude_m, 502, 0.01);
}

TEST(GeoReference, refusesFilesThatAreNone) {
    const TestFolder folder;
    EXPECT_THROW(readGeoReference(folder / "none.yaml"), Error);
    std::ofstream(folder / "bad.yaml") << "latitude_deg: 48\nlongitude_deg: east\n";
    EXPECT_THROW(readGeoReference(folder / "bad.yaml"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
