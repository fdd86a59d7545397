#include "rgbd_graphslam/mapping/map_builder.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "../../support/problem_of.h"
#include "box_room.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/mapping/depth_timing.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/recorded_images.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "rgbd_graphslam/mapping/scan_rawlog.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;
namespace fs = std::filesystem;

constexpr double first_stamp_s = 1305031102.175304;
const SE3 T_world_room(rotationExp({0.7, -0.4, 1.1}), {3, -2, 5});

/** A rawlog of a walk through the box room, with poses in a world that is not upright. */
class MapBuilder : public testing::Test {
  protected:
    MapBuilder() {
        fs::create_directories(folder_);
        const auto poses = walk(8);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            inputs_.keyframes.push_back(
                {first_stamp_s + 0.1 * static_cast<double>(i), T_world_room * poses[i]});
        }
        inputs_.trajectory = inputs_.keyframes;
        inputs_.rawlog = path("walk.rawlog");
        inputs_.loops = {{0, 7, 40}};
    }
    ~MapBuilder() override { fs::remove_all(folder_); }

    /** \param tilt turns what the accelerometer says away from the truth, rad */
    void writeWalk(bool with_accelerometer, double tilt = 0) const {
        writeRawlog(inputs_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (const auto& pose : inputs_.keyframes) {
                writeFrame(writer, pose);
                if (with_accelerometer) writeAccelerometer(writer, pose, tilt);
            }
        });
    }

    static void writeFrame(RawlogWriter& writer, const StampedPose& pose) {
        CameraSetup setup;
        setup.camera = smallCamera().intrinsics();
        const RgbdImage image =
            render(BoxRoom(), setup.camera, T_world_room.inverse() * pose.T_world_cam);
        const auto frame = makeRgbdObservation(setup, pose.stamp_s);
        setDepth(*frame, image.depth);
        setColor(*frame, image.color);
        writer.writeFrame(*frame, "");
    }

    static void writeAccelerometer(RawlogWriter& writer, const StampedPose& pose, double tilt) {
        const SE3 T_room_cam = T_world_room.inverse() * pose.T_world_cam;
        const Eigen::Vector3d up = rotationExp({tilt, 0, 0}) * Eigen::Vector3d(0, 0, 9.81);
        const Eigen::Vector3d force =
            T_optical_from_mrpt.R.transpose() * (T_room_cam.R.transpose() * up);
        for (int i = 0; i < 4; ++i) {
            mrpt::obs::CObservationIMU imu;
            imu.timestamp = toMrptTime(pose.stamp_s + 0.001 * i);
            imu.set(mrpt::obs::IMU_X_ACC, force.x());
            imu.set(mrpt::obs::IMU_Y_ACC, force.y());
            imu.set(mrpt::obs::IMU_Z_ACC, force.z());
            writer.write(imu);
        }
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    fs::path folder_ =
        fs::path(testing::TempDir()) / ("rgbd-map-builder-" + std::to_string(getpid()));
    MapInputs inputs_;
};

double tiltDegrees(const SE3& T_up_world) {
    const Eigen::Vector3d up = T_up_world.R * T_world_room.R.col(2);
    return std::acos(std::min(1., up.z())) * 180 / M_PI;
}

/** A pane of glass before a laser scanner in the camera's place: the depth image has none of it. */
class MapBuilderWithScanner : public MapBuilder {
  protected:
    static constexpr double pane_m = 0.8;

    /** \param sensor_z_m of the scanner above the camera */
    void writeWalkWithScans(double sensor_z_m) const {
        writeRawlog(inputs_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (const auto& pose : inputs_.keyframes) {
                writeFrame(writer, pose);
                mrpt::obs::CObservation2DRangeScan scan;
                scan.sensorLabel = "LASER";
                scan.timestamp = toMrptTime(pose.stamp_s);
                scan.sensorPose = mrpt::poses::CPose3D(0, 0, sensor_z_m, 0, 0, 0);
                scan.aperture = 0.2f;
                scan.maxRange = 20;
                scan.resizeScan(21);
                for (int i = 0; i < 21; ++i) {
                    scan.setScanRange(i, pane_m);
                    scan.setScanRangeValidity(i, true);
                }
                writer.write(scan);
            }
        });
    }

    mrpt::maps::COccupancyGridMap2D gridOfRun() const {
        writeMaps(transformed(T_world_room.inverse(), inputs_), MapOptions(), path("out"));
        return loadGridMap(path("out/grid.gridmap.gz"));
    }

    /** Whether the pane before a keyframe is an obstacle; nothing where it is not at an obstacle's
     *  height. */
    std::optional<bool> isObstacle(const mrpt::maps::COccupancyGridMap2D& grid,
                                   std::size_t keyframe) const {
        const Eigen::Vector3d pane = T_world_room.inverse() *
                                     inputs_.keyframes[keyframe].T_world_cam *
                                     Eigen::Vector3d(0, 0, pane_m);
        if (pane.z() < 0.15 || pane.z() > 1.4) return std::nullopt;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                const float free =
                    grid.getCell(grid.x2idx(pane.x()) + dx, grid.y2idx(pane.y()) + dy);
                if (free < 0.4f) return true;
            }
        }
        return false;
    }
};

TEST_F(MapBuilderWithScanner, glassThatOnlyTheScannerSeesIsAnObstacle) {
    writeWalk(false);
    const auto without = gridOfRun();
    writeWalkWithScans(0);
    const auto with = gridOfRun();
    std::size_t looked = 0, found = 0, found_without = 0;
    for (std::size_t k = 0; k < inputs_.keyframes.size(); ++k) {
        const auto obstacle = isObstacle(with, k);
        if (!obstacle) continue;
        ++looked;
        found += *obstacle;
        found_without += *isObstacle(without, k);
    }
    EXPECT_GT(looked, 2u);
    // Each scan has a pane of its own, and beams of some others pass through it.
    EXPECT_GE(found + 2, looked);
    EXPECT_LT(found_without, found);
}

TEST_F(MapBuilderWithScanner, scansAboveAllObstaclesAreLeftOutAndTold) {
    writeWalkWithScans(4);
    const WarningRecord record;
    gridOfRun();
    ASSERT_FALSE(record.warnings().empty());
    EXPECT_NE(record.warnings().back().find("no scan of the laser 'LASER' meets anything"),
              std::string::npos);
}

TEST_F(MapBuilder, uprightByTheFloorWithoutAccelerometer) {
    writeWalk(false);
    const SE3 T_up_world = T_gravity_world(inputs_, MapOptions());
    EXPECT_LT(tiltDegrees(T_up_world), 0.2);
    EXPECT_NEAR((T_up_world * (T_world_room * Eigen::Vector3d::Zero())).z(), 0, 0.01);
}

TEST_F(MapBuilder, levelSurfacesMendAnAccelerometerThatIsALittleOff) {
    writeWalk(true, 4 * M_PI / 180);
    EXPECT_LT(tiltDegrees(T_gravity_world(inputs_, MapOptions())), 0.2);
}

TEST_F(MapBuilder, accelerometerIsBelievedWhereTheFloorIsARamp) {
    writeWalk(true, 20 * M_PI / 180);
    EXPECT_NEAR(tiltDegrees(T_gravity_world(inputs_, MapOptions())), 20, 0.1);
    MapOptions by_floor;
    by_floor.upright = "floor";
    EXPECT_LT(tiltDegrees(T_gravity_world(inputs_, by_floor)), 0.2);
}

TEST_F(MapBuilder, accelerometerThatHasTheFloorOverheadIsLeftOut) {
    writeWalk(true, M_PI);
    const WarningRecord record;
    EXPECT_LT(tiltDegrees(T_gravity_world(inputs_, MapOptions())), 0.2);
    ASSERT_EQ(record.warnings().size(), 1u);
    EXPECT_NE(record.warnings()[0].find("--imu-accel-unit=-1"), std::string::npos);
}

TEST_F(MapBuilder, accelerometerByWhichTheCameraLiesOnItsSideIsDoubted) {
    for (const double tilt : {M_PI / 2, -M_PI / 2}) {
        writeWalk(true, tilt);
        const WarningRecord record;
        T_gravity_world(inputs_, MapOptions());
        ASSERT_EQ(record.warnings().size(), 1u);
        EXPECT_NE(record.warnings()[0].find("lies on its side"), std::string::npos);
    }
}

TEST_F(MapBuilder, withoutEitherTheFirstCameraIsLevel) {
    writeWalk(false);
    MapOptions options;
    options.upright = "none";
    const SE3 T_up_first =
        T_gravity_world(inputs_, options) * inputs_.keyframes.front().T_world_cam;
    EXPECT_LT((T_up_first.R.col(1) + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
}

TEST_F(MapBuilder, depthIsPlacedWhereTheCameraWasWhenItWasTaken) {
    constexpr double late_s = 0.012;
    const long long color_us = std::llround(1e6 * inputs_.keyframes[3].stamp_s);
    writeRawlog(inputs_.rawlog, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        mrpt::obs::CObservationComment comment;
        comment.text = toIniText(DepthStamps{{color_us, color_us + 12000}});
        writer.write(comment);
        for (const auto& pose : inputs_.keyframes) writeFrame(writer, pose);
    });
    const SE3 T_other_world(rotationExp({0.1, 0.2, 0.3}), {1, 2, 3});
    const Trajectory other = transformed(T_other_world, inputs_).trajectory;
    std::size_t late = 0;
    RecordedImages(RecordedCamera(inputs_.rawlog))
        .forEach(inputs_.keyframes, "reading", [&](const Keyframe3D& keyframe) {
            const SE3& T = keyframe.pose.T_world_cam;
            const double delay_s = keyframe.depth_stamp_s - keyframe.pose.stamp_s;
            if (keyframe.index != 3) {
                EXPECT_EQ(delay_s, 0);
                EXPECT_LT((depthPose(keyframe.pose, keyframe.depth_stamp_s, other).t - T.t).norm(),
                          1e-9);
                return;
            }
            ++late;
            EXPECT_NEAR(delay_s, late_s, 1e-6);
            const SE3 expected = interpolate(T, inputs_.keyframes[4].T_world_cam, late_s / 0.1);
            for (const Trajectory& trajectory : {inputs_.trajectory, other}) {
                const SE3 found = depthPose(keyframe.pose, keyframe.depth_stamp_s, trajectory);
                EXPECT_LT((found.t - expected.t).norm(), 1e-5);
                EXPECT_LT((found.R - expected.R).norm(), 1e-5);
            }
            EXPECT_EQ(depthPose(keyframe.pose, keyframe.depth_stamp_s, {}).t, T.t);
        });
    EXPECT_EQ(late, 1u);
}

TEST_F(MapBuilder, everyFileIsWrittenAndReadsBack) {
    writeWalk(false);
    const MapInputs upright = transformed(T_gravity_world(inputs_, MapOptions()), inputs_);
    const std::string out = path("out");
    const MapSummary summary = writeMaps(upright, MapOptions(), out);
    EXPECT_EQ(summary.keyframes, 8u);

    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(out))
        names.push_back(entry.path().filename().string());
    EXPECT_THAT(names, testing::UnorderedElementsAre("points.ply", "points.pcd", "points.metricmap",
                                                     "octree.bt", "octree.ot", "grid.gridmap.gz",
                                                     "grid.png", "grid.yaml", "map.simplemap",
                                                     "scene.3Dscene", "map.png", "map3d.jpg"));
    EXPECT_EQ(loadPly(out + "/points.ply").size(), summary.points);

    mrpt::maps::CSimpleMap simple;
    ASSERT_TRUE(simple.loadFromFile(out + "/map.simplemap"));
    EXPECT_EQ(simple.size(), 8u);

    mrpt::opengl::COpenGLScene scene;
    ASSERT_TRUE(scene.loadFromFile(out + "/scene.3Dscene"));
    const auto points = std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(
        scene.getByName(scene_names::points));
    ASSERT_TRUE(points);
    ASSERT_EQ(points->size(), summary.points);
    const PointMap saved = loadPly(out + "/points.ply");
    for (std::size_t i = 0; i < saved.size(); ++i) {
        const mrpt::img::TColor color =
            points->getPointColor(i);  // the fast one gives blue as green
        ASSERT_EQ((std::array{color.R, color.G, color.B}), saved[i].rgb) << i;
    }
    const auto loops =
        std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName(scene_names::loops));
    ASSERT_TRUE(loops);
    EXPECT_EQ(loops->getLineCount(), 1u);
    EXPECT_FALSE(cv::imread(out + "/map.png").empty());
}

TEST_F(MapBuilder, meshIsWrittenWhenAskedForAndGoesWithTheMapsItIsOf) {
    writeWalk(false);
    MapOptions options;
    options.mesh_voxel_m = 0.05;
    const MapSummary summary = writeMaps(inputs_, options, path("out"));
    const PlyModel mesh = readPly(path("out/mesh.ply"));
    EXPECT_EQ(mesh.triangles.size(), summary.triangles);
    EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
    EXPECT_EQ(mesh.colors.size(), mesh.vertices.size());
    int far = 0;
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
        const Eigen::Vector3d in_room = T_world_room.inverse() * vertex.cast<double>();
        far += BoxRoom().distanceToSurface(in_room) > 0.02;
    }
    EXPECT_LT(far, 0.05 * static_cast<double>(mesh.vertices.size()));
    EXPECT_EQ(writeMaps(inputs_, MapOptions(), path("out")).triangles, 0u);
    EXPECT_FALSE(fs::exists(path("out/mesh.ply")));
}

/** What robot-map-gui and pf-localization do with the simple map. */
TEST_F(MapBuilder, simpleMapMakesTheSameWallsIn2dAnd3d) {
    writeWalk(false);
    const MapInputs upright = transformed(T_gravity_world(inputs_, MapOptions()), inputs_);
    writeMaps(upright, MapOptions(), path("out"));
    mrpt::maps::CSimpleMap simple;
    ASSERT_TRUE(simple.loadFromFile(path("out/map.simplemap")));
    mrpt::maps::CSimplePointsMap cloud;
    for (std::size_t i = 0; i < simple.size(); ++i) {
        const auto [pose, frame] = simple.get(i);
        const mrpt::poses::CPose3D mean = pose->getMeanVal();
        cloud.insertObservation(*frame->getObservationByClass<mrpt::obs::CObservation3DRangeScan>(),
                                mean);
    }
    ASSERT_GT(cloud.size(), 1000u);
    // The way back from upright to the room.
    const SE3 T_room_up = T_world_room.inverse() * inputs_.keyframes[0].T_world_cam *
                          upright.keyframes[0].T_world_cam.inverse();
    int far = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        float x, y, z;
        cloud.getPoint(i, x, y, z);
        far += BoxRoom().distanceToSurface(T_room_up * Eigen::Vector3d(x, y, z)) > 0.03;
    }
    EXPECT_LT(far, 0.02 * static_cast<double>(cloud.size()));

    mrpt::maps::COccupancyGridMap2D grid(-5, 5, -5, 5, 0.05f);
    grid.insertionOptions.considerInvalidRangesAsFreeSpace = false;
    grid.loadFromSimpleMap(simple);
    int obstacles = 0, misplaced = 0;
    for (unsigned y = 0; y < grid.getSizeY(); ++y) {
        for (unsigned x = 0; x < grid.getSizeX(); ++x) {
            if (grid.getCell(static_cast<int>(x), static_cast<int>(y)) > 0.2f) continue;
            ++obstacles;
            const Eigen::Vector3d p =
                T_room_up * Eigen::Vector3d(grid.idx2x(x), grid.idx2y(y), 0.4);
            misplaced += BoxRoom().isFree(p, 0.1) && BoxRoom().isFree({p.x(), p.y(), 0.7}, 0.1);
        }
    }
    EXPECT_GT(obstacles, 100);
    EXPECT_LT(misplaced, 0.05 * obstacles);
}

TEST_F(MapBuilder, scansComeWithTheOdometryOfTheirBase) {
    writeWalk(false);
    const MapInputs upright = transformed(T_world_room.inverse(), inputs_);
    EXPECT_EQ(writeScans(upright, MapOptions(), 5, path("few.rawlog")), 4u);
    EXPECT_EQ(writeScans(upright, MapOptions(), 100, path("all.rawlog")), 8u);
    RawlogReader rawlog(path("all.rawlog"));
    EXPECT_TRUE(std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(rawlog.next()));
    for (const StampedPose& pose : upright.trajectory) {
        const auto odometry =
            std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(rawlog.next());
        const auto scan =
            std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(rawlog.next());
        ASSERT_TRUE(odometry && scan);
        EXPECT_NEAR(toSeconds(odometry->timestamp), pose.stamp_s, 1e-6);
        EXPECT_NEAR(toSeconds(scan->timestamp), pose.stamp_s, 1e-6);
        const Eigen::Vector3d forward = pose.T_world_cam.R.col(2);
        EXPECT_NEAR(odometry->odometry.x(), pose.T_world_cam.t.x(), 1e-6);
        EXPECT_NEAR(odometry->odometry.y(), pose.T_world_cam.t.y(), 1e-6);
        EXPECT_NEAR(odometry->odometry.phi(), std::atan2(forward.y(), forward.x()), 1e-6);
    }
    EXPECT_EQ(rawlog.next(), nullptr);
}

TEST_F(MapBuilder, mistakesInTheInputsAreNamed) {
    writeWalk(false);
    MapInputs wrong = inputs_;
    wrong.loops = {{0, 8, 1}};
    EXPECT_THAT(problemOf([&] { writeMaps(wrong, MapOptions(), path("out")); }),
                testing::HasSubstr("keyframe 8 of 8"));
    wrong = inputs_;
    for (auto& keyframe : wrong.keyframes) keyframe.stamp_s += 100;
    EXPECT_THAT(problemOf([&] { writeMaps(wrong, MapOptions(), path("out")); }),
                testing::HasSubstr("--rawlog"));
    wrong.keyframes.clear();
    EXPECT_THAT(problemOf([&] { writeMaps(wrong, MapOptions(), path("out")); }),
                testing::HasSubstr("no keyframe"));
}

class RunFolder : public MapBuilder {
  protected:
    RunFolder() {
        writeWalk(false);
        writeTextAtomically(path("keyframes.txt"), toTumText(inputs_.keyframes));
        writeTextAtomically(path("trajectory.txt"), toTumText(inputs_.trajectory));
        writeTextAtomically(path("summary.json"),
                            R"({"rawlog": "walk.rawlog", "loop_edges": [[0, 7, 40]]})");
    }
};

TEST_F(RunFolder, readsBackWhatMapsAreMadeOf) {
    const MapInputs read = readRunFolder(folder_.string(), "");
    EXPECT_EQ(read.keyframes.size(), 8u);
    EXPECT_EQ(read.rawlog, path("walk.rawlog"));
    ASSERT_EQ(read.loops.size(), 1u);
    EXPECT_EQ(read.loops[0].to, 7);
    EXPECT_EQ(writeMaps(read, MapOptions(), path("out")).keyframes, 8u);
}

TEST_F(RunFolder, loopsMayCarryTheirError) {
    writeTextAtomically(
        path("summary.json"),
        R"({"rawlog": "walk.rawlog", "loop_edges": [[0, 7, 40, 0.01], [1, 6, 30, null]]})");
    const MapInputs read = readRunFolder(folder_.string(), "");
    ASSERT_EQ(read.loops.size(), 2u);
    EXPECT_EQ(read.loops[0].inliers, 40);
    EXPECT_EQ(read.loops[1].from, 1);
}

TEST_F(RunFolder, framesWithoutPoseAreKnown) {
    EXPECT_TRUE(readRunFolder(folder_.string(), "").unplaced_s.empty());  // there is no such file
    const double first_s = inputs_.trajectory.front().stamp_s;
    std::string frames = "stamp_s,origin,inliers,keyframe,part\n";
    frames += formatted("%.6f,tracked,80,0,0\n%.6f,lost,0,,\n", first_s, first_s + 0.01);
    writeTextAtomically(path("frames.csv"), frames);
    const auto unplaced_s = readRunFolder(folder_.string(), "").unplaced_s;
    ASSERT_EQ(unplaced_s.size(), 1u);
    EXPECT_NEAR(unplaced_s[0], first_s + 0.01, 1e-6);
    writeTextAtomically(path("frames.csv"), frames + "oops\n");
    EXPECT_THAT(problemOf([&] { readRunFolder(folder_.string(), ""); }),
                testing::HasSubstr("frames.csv:4"));
}

TEST_F(RunFolder, optionsAreReadPastOtherSections) {
    EXPECT_EQ(readRunOptions(folder_.string()).octree_resolution_m, 0.05);
    writeTextAtomically(
        path("config.ini"),
        "[TrackerOptions]\nfeatures = 7\n[MapOptions]\noctree_resolution_m = 0.08\n");
    EXPECT_EQ(readRunOptions(folder_.string()).octree_resolution_m, 0.08);
    writeTextAtomically(path("config.ini"), "[MapOptions]\noctree_resolution = 0.08\n");
    EXPECT_THAT(problemOf([&] { readRunOptions(folder_.string()); }),
                testing::HasSubstr("config.ini:2"));
}

TEST_F(RunFolder, whatIsMissingOrBrokenIsNamed) {
    const auto problem = [&] { return problemOf([&] { readRunFolder(folder_.string(), ""); }); };
    writeTextAtomically(path("summary.json"), R"({"rawlog": "gone.rawlog"})");
    EXPECT_THAT(problem(),
                testing::AllOf(testing::HasSubstr("gone.rawlog"), testing::HasSubstr("--rawlog")));
    writeTextAtomically(path("summary.json"), "{}");
    EXPECT_THAT(problem(), testing::HasSubstr("--rawlog"));
    EXPECT_EQ(problemOf([&] { readRunFolder(folder_.string(), path("walk.rawlog")); }), "");
    writeTextAtomically(path("summary.json"), R"({"rawlog": "walk.ra)");
    EXPECT_THAT(problem(), testing::HasSubstr("summary.json"));
    writeTextAtomically(path("summary.json"), R"({"rawlog": "walk.rawlog", "loop_edges": "none"})");
    EXPECT_THAT(problem(), testing::HasSubstr("loop_edges"));
    writeTextAtomically(path("summary.json"),
                        R"({"rawlog": "walk.rawlog", "loop_edges": [[0, 7]]})");
    EXPECT_THAT(problem(), testing::HasSubstr("loop_edges"));
    fs::remove(path("keyframes.txt"));
    EXPECT_THAT(problem(), testing::HasSubstr("keyframes.txt"));
    EXPECT_THAT(problem(), testing::HasSubstr("no output folder of rgbd-slam"));
    EXPECT_THAT(problemOf([&] { readRunFolder(path("none"), ""); }), testing::HasSubstr("none"));
}

TEST(MapInputsOfParts, keyframesApartAreLeftOutAndTheRestCountedAnew) {
    MapInputs inputs;
    for (int k = 0; k < 7; ++k) inputs.keyframes.push_back({1.0 * k, SE3()});
    inputs.keyframes_before_loops = inputs.keyframes;
    inputs.loops = {{0, 6, 50}, {1, 3, 60}, {2, 5, 70}};
    inputs.earlier = {{"a", 2}, {"b", 3}};
    inputs.disconnected = {1, 4};
    const MapInputs left = withoutDisconnected(inputs);
    ASSERT_EQ(left.keyframes.size(), 5u);
    EXPECT_EQ(left.keyframes[1].stamp_s, 2);
    EXPECT_EQ(left.keyframes_before_loops[3].stamp_s, 5);
    ASSERT_EQ(left.loops.size(), 2u);
    EXPECT_EQ(left.loops[0].to, 4);
    EXPECT_EQ(left.loops[1].from, 1);
    EXPECT_EQ(left.loops[1].to, 3);
    EXPECT_EQ(left.earlier[0].keyframes, 1u);
    EXPECT_EQ(left.earlier[1].keyframes, 2u);
}

}  // namespace
}  // namespace rgbd_graphslam
