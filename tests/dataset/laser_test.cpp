/** rgbd-slam on recordings with a laser scanner or GPS and no camera, from file to folder. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "../support/floor_plan.h"
#include "../support/run_program.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/geometry/geodetic.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double first_s = 1000;

struct Drive {
    std::vector<PlanarPose> truth, odometry;
    std::vector<mrpt::obs::CObservation2DRangeScan::Ptr> scans;
};

Drive ringDrive(int seed, const std::vector<Eigen::Vector2d>& corners) {
    const FloorPlan plan = ringOfCorridors();
    RandomInputs random(seed);
    Drive drive;
    drive.truth = driveAlong(corners);
    drive.odometry = odometryOf(drive.truth, 1.03, 1.05, random);
    for (std::size_t i = 0; i < drive.truth.size(); ++i) {
        drive.scans.push_back(
            scanOf(plan, drive.truth[i], first_s + 0.1 * static_cast<double>(i), random));
    }
    return drive;
}

mrpt::obs::CObservationOdometry odometryAt(double stamp_s, const PlanarPose& pose) {
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "WHEELS";
    odometry.timestamp = toMrptTime(stamp_s);
    odometry.odometry = mrpt::poses::CPose2D(pose.x, pose.y, pose.yaw);
    return odometry;
}

void writeObservations(const Drive& drive, const std::string& path, bool with_odometry = true) {
    writeRawlog(path, RawlogStorage::Embedded, [&](RawlogWriter& rawlog) {
        for (std::size_t i = 0; i < drive.scans.size(); ++i) {
            auto odometry = odometryAt(first_s + 0.1 * static_cast<double>(i), drive.odometry[i]);
            if (with_odometry) rawlog.write(odometry);
            rawlog.write(*drive.scans[i]);
        }
    });
}

/** The same drive as pairs of an action and a sensory frame. */
void writeActions(const Drive& drive, const std::string& path) {
    mrpt::io::CFileGZOutputStream file(path);
    auto archive = mrpt::serialization::archiveFrom(file);
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        const PlanarPose before = i > 0 ? drive.odometry[i - 1] : drive.odometry[0];
        const PlanarPose step = before.inverse() * drive.odometry[i];
        mrpt::obs::CActionRobotMovement2D motion;
        motion.computeFromOdometry(mrpt::poses::CPose2D(step.x, step.y, step.yaw), {});
        mrpt::obs::CActionCollection actions;
        actions.insert(motion);
        archive << actions;
        mrpt::obs::CSensoryFrame frame;
        frame.insert(drive.scans[i]);
        archive << frame;
    }
}

std::string slam(const TestFolder& folder, const std::string& rawlog, const std::string& out,
                 const std::string& more = {}) {
    const ProgramResult result =
        runProgram("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + folder / rawlog +
                                    "' -o '" + folder / out + "' " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
}

std::string refusal(const TestFolder& folder, const std::string& rawlog,
                    const std::string& more = {}) {
    const ProgramResult result = runProgram(
        "rgbd-slam", "'" + folder / rawlog + "' -o '" + folder / "refused" + "' " + more);
    EXPECT_EQ(result.exit_code, 1);
    return result.err;
}

nlohmann::json summaryOf(const TestFolder& folder, const std::string& out) {
    return nlohmann::json::parse(readText(folder / (out + "/summary.json")));
}

double worstError(const Trajectory& trajectory, const Drive& drive) {
    double worst = 0;
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
        const PlanarPose expected = drive.truth.front().inverse() * drive.truth[i];
        worst =
            std::max(worst, (trajectory[i].T_world_cam.t.head<2>() - positionOf(expected)).norm());
    }
    return worst;
}

TEST(LaserRun, mapsARingOfCorridors) {
    const TestFolder folder;
    const Drive drive = ringDrive(1, roundsInRing(1));
    writeObservations(drive, folder / "ring.rawlog");
    EXPECT_THAT(slam(folder, "ring.rawlog", "out"), Not(HasSubstr("warning")));
    const Trajectory trajectory = readTumTrajectory(folder / "out/trajectory.txt");
    ASSERT_EQ(trajectory.size(), drive.truth.size());
    EXPECT_NEAR(trajectory[7].stamp_s, first_s + 0.7, 1e-6);
    EXPECT_LT(worstError(trajectory, drive), 0.08);
    const auto summary = summaryOf(folder, "out");
    EXPECT_GT(summary.at("loops").get<int>(), 0);
    EXPECT_EQ(summary.at("tracked").get<std::size_t>(), drive.truth.size());
    EXPECT_EQ(summary.at("sensor_figures").at(0).at("label"), "LASER");
    EXPECT_NEAR(summary.at("sensor_figures").at(0).at("rate_hz").get<double>(), 10, 0.1);
    const auto grid = loadGridMap(folder / "out/grid.gridmap.gz");
    const auto at = [&](double x, double y) {  // in the world of the first pose, (1, 1)
        return grid.getCell(grid.x2idx(x - 1), grid.y2idx(y - 1));
    };
    EXPECT_GT(at(10, 1), 0.7f);
    EXPECT_NEAR(at(10, 7), 0.5f, 0.05f);  // inside the block
    EXPECT_LT(std::min(at(10, 0.02), at(10, -0.03)), 0.3f);
    for (const char* name : {"keyframes.txt", "graph.graph", "grid.png", "grid.yaml", "map.png",
                             "map.simplemap", "points.ply", "report.html", "frames.csv"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / (std::string("out/") + name))) << name;
    }
    EXPECT_THAT(readText(folder / "out/report.html"), HasSubstr("CObservation2DRangeScan"));
}

TEST(LaserRun, bothFormsOfRawlogsAndAnyNumberOfThreadsGiveTheSame) {
    const TestFolder folder;
    const Drive drive = ringDrive(2, {{1, 1}, {8, 1}});
    writeObservations(drive, folder / "observations.rawlog");
    writeActions(drive, folder / "actions.rawlog");
    slam(folder, "observations.rawlog", "a");
    slam(folder, "observations.rawlog", "b", "--threads 1");
    slam(folder, "actions.rawlog", "c");
    EXPECT_EQ(readText(folder / "a/trajectory.txt"), readText(folder / "b/trajectory.txt"));
    const Trajectory a = readTumTrajectory(folder / "a/trajectory.txt"),
                     c = readTumTrajectory(folder / "c/trajectory.txt");
    ASSERT_EQ(a.size(), c.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].stamp_s, c[i].stamp_s);
        EXPECT_LT((a[i].T_world_cam.t - c[i].T_world_cam.t).norm(), 1e-3);
    }
}

TEST(LaserRun, tellsInOneLineWhatIsWrong) {
    const TestFolder folder;
    Drive drive = ringDrive(3, {{1, 1}, {4, 1}});
    writeObservations(drive, folder / "no_odometry.rawlog", false);
    EXPECT_THAT(slam(folder, "no_odometry.rawlog", "out"), HasSubstr("warning: no odometry"));

    std::swap(drive.scans[10], drive.scans[11]);
    writeObservations(drive, folder / "order.rawlog");
    EXPECT_THAT(slam(folder, "order.rawlog", "out"),
                HasSubstr("1 scans are not later than the one before"));
    EXPECT_THAT(refusal(folder, "order.rawlog", "--sensor REAR"),
                HasSubstr("has no laser 'REAR'; it has 'LASER'"));
    EXPECT_THAT(refusal(folder, "order.rawlog", "--map out --localize"),
                HasSubstr("has no camera: --map needs RGB-D frames"));

    for (const auto& scan : drive.scans) {
        scan->sensorPose = mrpt::poses::CPose3D(0, 0, 0.3, 0, 0.8, 0);
    }
    writeObservations(drive, folder / "tilted.rawlog");
    EXPECT_THAT(refusal(folder, "tilted.rawlog"), HasSubstr("tilted by 46 degrees"));

    for (const auto& scan : drive.scans) {
        scan->sensorPose = {};
        for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
            scan->setScanRange(i, scan->maxRange);
            scan->setScanRangeValidity(i, true);
        }
    }
    writeObservations(drive, folder / "far.rawlog");
    EXPECT_THAT(refusal(folder, "far.rawlog"),
                HasSubstr("below the scanner's maximum of 25 m; check the unit"));
}

/** A drive over 60 m with fixes of 1 m noise. */
void writeYard(const std::string& path) {
    const LocalTangentPlane plane({48.1, 11.6, 500});
    RandomInputs random(5);
    const auto truth = driveAlong({{0, 0}, {25, 0}, {25, 15}, {0, 15}, {0, 2}});
    const auto wheels = odometryOf(truth, 1.01, 1.02, random);
    writeRawlog(path, RawlogStorage::Embedded, [&](RawlogWriter& rawlog) {
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double stamp_s = first_s + 0.1 * static_cast<double>(i);
            auto odometry = odometryAt(stamp_s, wheels[i]);
            rawlog.write(odometry);
            if (i % 4 != 0) continue;
            const GeodeticPlace place = plane.toGeodetic(
                {truth[i].x + random.gauss(), truth[i].y + random.gauss(), 2 * random.gauss()});
            mrpt::obs::gnss::Message_NMEA_GGA gga;
            gga.fields.latitude_degrees = place.latitude_deg;
            gga.fields.longitude_degrees = place.longitude_deg;
            gga.fields.altitude_meters = place.altitude_m;
            gga.fields.fix_quality = 1;
            mrpt::obs::CObservationGPS gps;
            gps.sensorLabel = "GPS";
            gps.timestamp = toMrptTime(stamp_s);
            gps.setMsg(gga);
            rawlog.write(gps);
        }
    });
}

TEST(GpsRun, fusesAndGeoreferences) {
    const TestFolder folder;
    writeYard(folder / "yard.rawlog");
    slam(folder, "yard.rawlog", "out", "--set GpsOptions.hold_out_every=2");
    const GeoReference reference = readGeoReference(folder / "out/georeference.yaml");
    const Trajectory trajectory = readTumTrajectory(folder / "out/trajectory.txt");
    const LocalTangentPlane plane({48.1, 11.6, 500});
    const auto at = poseAt(trajectory, first_s + 50);  // on the way along the first side
    ASSERT_TRUE(at);
    const Eigen::Vector3d enu = plane.toEnu(reference.place(at->t));
    EXPECT_NEAR(enu.x(), 25, 1);
    EXPECT_NEAR(enu.y(), 0, 1);
    const auto use = summaryOf(folder, "out").at("sensor_figures").at(0).at("use");
    EXPECT_THAT(use.get<std::string>(), HasSubstr("fixes held out"));
    const ProgramResult exported =
        runProgram("rgbd-export", "'" + folder / "out" + "' --to kml --to geojson");
    EXPECT_EQ(exported.exit_code, 0) << exported.err;
    EXPECT_THAT(readText(folder / "out/export/trajectory.kml"), HasSubstr("\n11.600"));
    const auto json = nlohmann::json::parse(readText(folder / "out/export/trajectory.geojson"));
    EXPECT_EQ(json.at("features").at(0).at("geometry").at("coordinates").size(), trajectory.size());
}

}  // namespace
}  // namespace rgbd_graphslam
