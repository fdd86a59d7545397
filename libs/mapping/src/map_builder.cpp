#include "rgbd_graphslam/mapping/map_builder.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/depth_timing.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/masked_images.h"
#include "rgbd_graphslam/mapping/moving_filter.h"
#include "rgbd_graphslam/mapping/perspective_view.h"
#include "rgbd_graphslam/mapping/plan_view.h"
#include "rgbd_graphslam/mapping/recorded_images.h"
#include "rgbd_graphslam/mapping/simple_map.h"
#include "rgbd_graphslam/mapping/view_coverage.h"
#include "scan_layer.h"

namespace rgbd_graphslam {
namespace {

/** What the maps are made with. */
struct Maps {
    std::optional<MovingFilter> moving;
    std::optional<Camera> camera;
    std::optional<DenseMapper> dense;
    std::optional<ViewCoverage> coverage;
    mrpt::maps::CSimpleMap simple;
    ScanLayer scans;
    double insert_ms = 0;

    void addSight(const Keyframe3D& frame, const MapInputs& inputs, int session) {
        const ThreadClock clock;
        if (!moving) moving.emplace(frame.camera);
        moving->add(frame.image, frame.pose.stamp_s,
                    depthPose(frame.pose, frame.depth_stamp_s, inputs.trajectory), session);
        insert_ms += clock.cpuMs();
    }

    void add(const Keyframe3D& keyframe, const MapInputs& inputs, const MapOptions& options,
             int session) {
        if (!dense) {
            camera = keyframe.camera;
            dense.emplace(options, keyframe.camera);
            coverage.emplace(keyframe.camera, inputs.keyframes);
        }
        const SE3 T_world_cam = depthPose(keyframe.pose, keyframe.depth_stamp_s, inputs.trajectory);
        const ThreadClock clock;
        const double stamp_s = keyframe.pose.stamp_s;
        const DepthView view = dense->view(
            moving ? moving->withoutMovers(keyframe.image, stamp_s, T_world_cam, session)
                   : keyframe.image);
        dense->insert(T_world_cam, view);
        insert_ms += clock.cpuMs();
        coverage->add(keyframe.pose.T_world_cam);
        dense->checkMemory(coverage->share());
        addKeyframe(simple, keyframe.depth_stamp_s, T_world_cam, view, options);
    }

    void finish() {
        const ThreadClock clock;
        dense->finish();
        insert_ms += clock.cpuMs();
    }
};

/** The images of a session with the poses of those of its frames that are looked at. */
struct Recording {
    std::unique_ptr<KeyframeImages> images;
    Trajectory keyframes, sights;
    bool is_earlier;
};

std::unique_ptr<KeyframeImages> imagesOf(const RecordedCamera& camera,
                                         const std::string& moving_classes) {
    auto images = std::make_unique<RecordedImages>(camera);
    if (moving_classes.empty()) return images;
    return std::make_unique<MaskedImages>(std::move(images), camera.sensor_label, moving_classes);
}

/** In order of the sessions. */
std::vector<Recording> recordingsOf(const MapInputs& inputs) {
    std::vector<Recording> recordings;
    auto begin = inputs.keyframes.begin();
    for (const EarlierSession& session : inputs.earlier) {
        const Trajectory keyframes(begin, begin + static_cast<std::ptrdiff_t>(session.keyframes));
        begin += static_cast<std::ptrdiff_t>(session.keyframes);
        recordings.push_back({imagesOf({session.rawlog, session.sensor_label, session.entries},
                                       inputs.moving_classes),
                              keyframes, keyframes, true});
    }
    recordings.push_back(
        {imagesOf({inputs.rawlog, inputs.sensor_label, inputs.entries}, inputs.moving_classes),
         {begin, inputs.keyframes.end()},
         sightsOf(inputs),
         false});
    return recordings;
}

/** What is amiss with a recording is told when its keyframes are mapped. */
void addSights(Maps& maps, const MapInputs& inputs, const std::vector<Recording>& recordings) {
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        if (recordings[i].sights.empty()) continue;
        try {
            recordings[i].images->forEach(recordings[i].sights, "free space",
                                          [&](const Keyframe3D& frame) {
                                              maps.addSight(frame, inputs, static_cast<int>(i));
                                          });
        } catch (const Error& e) {
            sayDetail(std::string("not all frames tell of free space: ") + e.what());
        }
    }
}

/** \return how many keyframes were added */
std::size_t addSessions(Maps& maps, const MapInputs& inputs, const MapOptions& options) {
    const std::vector<Recording> recordings = recordingsOf(inputs);
    if (options.drop_points_in_free_space) addSights(maps, inputs, recordings);
    std::size_t added = 0;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        if (recordings[i].keyframes.empty()) continue;
        try {
            const Trajectory& way =
                recordings[i].is_earlier ? recordings[i].keyframes : inputs.trajectory;
            std::optional<SE3> T_base_cam;
            added += recordings[i].images->forEach(
                recordings[i].keyframes, "mapping",
                [&](const Keyframe3D& keyframe) {
                    maps.add(keyframe, inputs, options, static_cast<int>(i));
                    T_base_cam = keyframe.T_base_cam;
                },
                [&](const mrpt::obs::CObservation& entry) { maps.scans.note(entry, way); });
            if (T_base_cam) maps.scans.place(*T_base_cam);
        } catch (const Error& e) {
            if (!recordings[i].is_earlier) throw;
            sayWarning(std::string("an earlier session is left out of the maps: ") + e.what());
        }
    }
    return added;
}

/** A mesh of earlier maps would be of other poses: without a new one it goes, too. Last, so that
 * what ends early loses nothing. \return triangles */
std::size_t writeMesh(const DenseMapper& dense, const std::string& path) {
    if (!dense.hasMesh()) {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
        return 0;
    }
    const PlyModel mesh = dense.mesh();
    writePly(path, mesh);
    return mesh.triangles.size();
}

void writePictures(const MapInputs& inputs, const PointMap& points, double spacing_m,
                   const std::string& folder) {
    const auto write = [&](const char* name, const cv::Mat& picture) {
        sayDetail(std::string("writing ") + name);
        writeAtomically(folder + "/" + name, [&](const std::string& temporary) {
            return cv::imwrite(temporary, picture);
        });
    };
    write("map.png", planView(inputs, points));
    write("map3d.jpg", perspectiveView(inputs, points, spacing_m));
}

MapSummary writeFiles(const MapInputs& inputs, const Maps& maps, const MapOptions& options,
                      const std::string& folder) {
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
    summary.scans = maps.scans.mergeInto(grid, options);
    saveMrptObject(path("grid.gridmap.gz"), grid);
    saveRosGrid(path("grid"), grid);
    saveMrptObject(path("map.simplemap"), maps.simple);
    saveMrptObject(path("scene.3Dscene"), makeScene(inputs, points, *maps.camera));
    writePictures(inputs, points, options.point_voxel_m, folder);
    summary.triangles = writeMesh(*maps.dense, path("mesh.ply"));
    summary.points = points.size();
    summary.octree_leaves = tree->getNumLeafNodes();
    summary.grid_width = static_cast<int>(grid.getSizeX());
    summary.grid_height = static_cast<int>(grid.getSizeY());
    return summary;
}

}  // namespace

MapSummary writeMaps(const MapInputs& inputs, const MapOptions& options,
                     const std::string& out_folder) {
    checkInputs(inputs);
    const MapInputs connected = withoutDisconnected(inputs);
    makeWritableFolder(out_folder);
    Maps maps;
    const std::size_t found = addSessions(maps, connected, options);
    if (found == 0) throw Error("no rawlog of the keyframes is left", "give --rawlog FILE");
    maps.finish();
    MapSummary summary = writeFiles(connected, maps, options, out_folder);
    summary.keyframes = found;
    summary.insert_ms = maps.insert_ms / static_cast<double>(found);
    const auto megabytes = [](std::size_t bytes) { return 1e-6 * static_cast<double>(bytes); };
    summary.megabytes = megabytes(maps.dense->bytes());
    summary.points_megabytes = megabytes(maps.dense->pointBytes());
    summary.octree_megabytes = megabytes(maps.dense->octreeBytes());
    summary.mesh_megabytes = megabytes(maps.dense->meshBytes());
    return summary;
}

}  // namespace rgbd_graphslam
