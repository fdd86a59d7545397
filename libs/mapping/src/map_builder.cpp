#include "rgbd_graphslam/mapping/map_builder.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <chrono>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/keyframe_reader.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/plan_view.h"
#include "rgbd_graphslam/mapping/simple_map.h"
#include "rgbd_graphslam/mapping/upright.h"
#include "rgbd_graphslam/mapping/view_coverage.h"

namespace rgbd_graphslam {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::optional<Eigen::Vector3d> specificForce(const mrpt::obs::CObservationIMU& imu) {
    using namespace mrpt::obs;
    if (!imu.has(IMU_X_ACC) || !imu.has(IMU_Y_ACC) || !imu.has(IMU_Z_ACC)) return std::nullopt;
    return Eigen::Vector3d(imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC));
}

/** Nothing at the end, and where the rawlog is cut off: what comes before serves. */
mrpt::obs::CObservation::Ptr nextUndamaged(RawlogReader& reader) {
    try {
        return reader.next();
    } catch (const Error& e) {
        sayDetail(e.what());
        return nullptr;
    }
}

/** All accelerometer readings of a rawlog, in the axes of its camera. */
std::vector<SpecificForce> readAccelerometer(const std::string& rawlog) {
    std::vector<SpecificForce> readings;
    std::optional<SE3> T_base_cam;
    RawlogReader reader(rawlog);
    while (const auto observation = nextUndamaged(reader)) {
        const auto frame =
            std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
        if (frame && !T_base_cam) T_base_cam = cameraOnRobot(*frame);
        const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(observation);
        const auto force = imu ? specificForce(*imu) : std::nullopt;
        if (force)
            readings.push_back({toSeconds(imu->timestamp), toSE3(imu->sensorPose).R * *force});
    }
    if (!T_base_cam)
        throw Error("'" + rawlog + "' holds no RGB-D frame", "give a rawlog of an RGB-D camera");
    for (auto& reading : readings)
        reading.in_camera = T_base_cam->R.transpose() * reading.in_camera;
    return readings;
}

/** Evenly chosen, at most `count`. */
Trajectory someOf(const Trajectory& poses, std::size_t count) {
    Trajectory some;
    const std::size_t step = std::max<std::size_t>(1, (poses.size() + count - 1) / count);
    for (std::size_t i = 0; i < poses.size(); i += step) some.push_back(poses[i]);
    return some;
}

std::vector<SurfacePatch> readPatches(const MapInputs& inputs, const MapOptions& options) {
    constexpr std::size_t enough_keyframes = 60;
    std::vector<SurfacePatch> patches;
    std::optional<RayTable> rays;
    forEachKeyframe(inputs.rawlog, someOf(inputs.keyframes, enough_keyframes), "finding the floor",
                    [&](const Keyframe3D& keyframe) {
                        if (!rays) rays.emplace(keyframe.camera);
                        const DepthView view(keyframe.image, *rays, options);
                        const SE3 T = depthPose(keyframe, inputs.trajectory);
                        const auto found = surfacePatches(T, view);
                        patches.insert(patches.end(), found.begin(), found.end());
                    });
    return patches;
}

/** Cameras are mostly held upright. */
Eigen::Vector3d meanCameraTop(const Trajectory& poses) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& pose : poses) sum -= pose.T_world_cam.R.col(1);
    return sum.normalized();
}

/** A Kinect's accelerometer is some 4 degrees off (TUM fr1/xyz against its ground truth), a floor
 *  well below one: so gravity says which surfaces are level, and these say what level is. */
Eigen::Vector3d findUp(const MapInputs& inputs, const MapOptions& options,
                       const std::vector<SurfacePatch>& patches) {
    constexpr double accelerometer_error = 8 * M_PI / 180, camera_error = M_PI / 4;
    const Trajectory& poses = inputs.trajectory.empty() ? inputs.keyframes : inputs.trajectory;
    if (options.upright == "gravity") {
        if (const auto up = upFromAccelerometer(readAccelerometer(inputs.rawlog), poses)) {
            return upFromFloor(patches, *up, accelerometer_error).value_or(*up);
        }
        sayInfo("no usable accelerometer in the rawlog: up is taken from the floor");
    }
    if (options.upright != "none") {
        const auto up = upFromFloor(patches, meanCameraTop(inputs.keyframes), camera_error);
        if (up) return *up;
    }
    sayWarning("up is taken from the first camera, as if it had been level");
    return -inputs.keyframes.front().T_world_cam.R.col(1);
}

void checkInputs(const MapInputs& inputs) {
    if (inputs.keyframes.empty())
        throw Error("there is no keyframe to make maps of", "check the trajectory");
    const int count = static_cast<int>(inputs.keyframes.size());
    std::size_t earlier = 0;
    for (const EarlierSession& session : inputs.earlier) earlier += session.keyframes;
    if (earlier > inputs.keyframes.size())
        throw Error("earlier sessions name more keyframes than there are");
    for (const MapLoopEdge& loop : inputs.loops) {
        if (std::min(loop.from, loop.to) >= 0 && std::max(loop.from, loop.to) < count) continue;
        throw Error("a loop names keyframe " + std::to_string(std::max(loop.from, loop.to)) +
                    " of " + std::to_string(count));
    }
}

/** What one pass over the rawlog makes. */
struct Maps {
    std::optional<Camera> camera;
    std::optional<RayTable> rays;
    std::optional<DenseMapper> dense;
    std::optional<ViewCoverage> coverage;
    mrpt::maps::CSimpleMap simple;
    double insert_ms = 0;

    void add(const Keyframe3D& keyframe, const MapInputs& inputs, const MapOptions& options) {
        if (!dense) {
            camera = keyframe.camera;
            rays.emplace(keyframe.camera);
            dense.emplace(options, keyframe.camera);
            coverage.emplace(keyframe.camera, inputs.keyframes);
        }
        const SE3 T_world_cam = depthPose(keyframe, inputs.trajectory);
        const auto start = Clock::now();
        dense->insert(T_world_cam, keyframe.image);
        insert_ms += millisecondsSince(start);
        coverage->add(keyframe.pose.T_world_cam);
        dense->checkMemory(coverage->share());
        addKeyframe(simple, keyframe.depth_stamp_s, T_world_cam,
                    DepthView(keyframe.image, *rays, options), options);
    }

    void finish() {
        const auto start = Clock::now();
        dense->finish();
        insert_ms += millisecondsSince(start);
    }
};

std::size_t addSession(Maps& maps, const MapInputs& inputs, const MapOptions& options,
                       const std::string& rawlog, const Trajectory& keyframes) {
    return forEachKeyframe(rawlog, keyframes, "mapping", [&](const Keyframe3D& keyframe) {
        maps.add(keyframe, inputs, options);
    });
}

/** \return how many keyframes were added */
std::size_t addSessions(Maps& maps, const MapInputs& inputs, const MapOptions& options) {
    std::size_t added = 0;
    auto begin = inputs.keyframes.begin();
    for (const EarlierSession& session : inputs.earlier) {
        const Trajectory keyframes(begin, begin + static_cast<std::ptrdiff_t>(session.keyframes));
        begin += static_cast<std::ptrdiff_t>(session.keyframes);
        if (keyframes.empty()) continue;
        try {
            added += addSession(maps, inputs, options, session.rawlog, keyframes);
        } catch (const Error& e) {
            sayWarning(std::string("an earlier session is left out of the maps: ") + e.what());
        }
    }
    if (begin == inputs.keyframes.end()) return added;
    return added +
           addSession(maps, inputs, options, inputs.rawlog, {begin, inputs.keyframes.end()});
}

MapSummary writeFiles(const MapInputs& inputs, const Maps& maps, const std::string& folder) {
    const auto path = [&](const char* name) {
        sayDetail(std::string("writing ") + name);
        return folder + "/" + name;
    };
    MapSummary summary;
    const PointMap points = maps.dense->points();
    savePly(path("points.ply"), points);
    savePcd(path("points.pcd"), points);
    saveMetricMap(path("points.metricmap"), points);
    const auto tree = maps.dense->octree(LeafValues::MaximumLikelihood);
    saveBinaryOcTree(path("octree.bt"), *tree);
    saveColorOcTree(path("octree.ot"), *maps.dense->colorOctree());
    mrpt::maps::COccupancyGridMap2D grid;
    maps.dense->grid(grid);
    saveMrptObject(path("grid.gridmap.gz"), grid);
    saveRosGrid(path("grid"), grid);
    saveMrptObject(path("map.simplemap"), maps.simple);
    saveMrptObject(path("scene.3Dscene"), makeScene(inputs, points, *maps.camera));
    const cv::Mat picture = planView(inputs, points);
    writeAtomically(path("map.png"),
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
    summary.points = points.size();
    summary.octree_leaves = tree->getNumLeafNodes();
    summary.grid_width = static_cast<int>(grid.getSizeX());
    summary.grid_height = static_cast<int>(grid.getSizeY());
    return summary;
}

}  // namespace

SE3 uprightFromWorld(const MapInputs& all, const MapOptions& options) {
    checkInputs(all);
    const MapInputs inputs = withoutApart(all);
    const auto patches = readPatches(inputs, options);
    const Eigen::Vector3d up = findUp(inputs, options, patches);
    const auto floor = floorHeight(patches, up);
    if (!floor) sayWarning("no level surface was seen: the first camera is taken to be at z = 0");
    const SE3& T_first = inputs.keyframes.front().T_world_cam;
    return uprightFrame(up, floor.value_or(up.dot(T_first.t)), T_first);
}

MapInputs withoutApart(const MapInputs& inputs) {
    MapInputs result = inputs;
    result.apart.clear();
    result.keyframes.clear();
    result.loops.clear();
    result.keyframes_before_loops.clear();
    const auto& apart = inputs.apart;
    std::vector<int> number;
    for (std::size_t k = 0; k < inputs.keyframes.size(); ++k) {
        const bool left_out = std::binary_search(apart.begin(), apart.end(), static_cast<int>(k));
        number.push_back(left_out ? -1 : static_cast<int>(result.keyframes.size()));
        if (left_out) continue;
        result.keyframes.push_back(inputs.keyframes[k]);
        if (k < inputs.keyframes_before_loops.size())
            result.keyframes_before_loops.push_back(inputs.keyframes_before_loops[k]);
    }
    for (const MapLoopEdge& loop : inputs.loops) {
        if (number[loop.from] < 0 || number[loop.to] < 0) continue;
        result.loops.push_back({number[loop.from], number[loop.to], loop.inliers});
    }
    std::size_t begin = 0;
    for (EarlierSession& session : result.earlier) {
        const auto first = number.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = first + static_cast<std::ptrdiff_t>(session.keyframes);
        begin += session.keyframes;
        session.keyframes -= static_cast<std::size_t>(std::count(first, last, -1));
    }
    return result;
}

MapInputs transformed(const SE3& T_a_world, MapInputs inputs) {
    for (Trajectory* poses :
         {&inputs.keyframes, &inputs.trajectory, &inputs.keyframes_before_loops}) {
        for (auto& pose : *poses) pose.T_world_cam = T_a_world * pose.T_world_cam;
    }
    return inputs;
}

MapSummary writeMaps(const MapInputs& all, const MapOptions& options,
                     const std::string& out_folder) {
    checkInputs(all);
    const MapInputs inputs = withoutApart(all);
    makeWritableFolder(out_folder);
    Maps maps;
    const std::size_t found = addSessions(maps, inputs, options);
    if (found == 0) throw Error("no rawlog of the keyframes is left", "give --rawlog FILE");
    maps.finish();
    MapSummary summary = writeFiles(inputs, maps, out_folder);
    summary.keyframes = found;
    summary.insert_ms = maps.insert_ms / static_cast<double>(found);
    summary.megabytes = 1e-6 * static_cast<double>(maps.dense->bytes());
    return summary;
}

}  // namespace rgbd_graphslam
