#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "cameraless_run.h"
#include "output_texts.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/fusion/geo_alignment.h"
#include "rgbd_graphslam/graphslam/keyframe_graph.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/plan_view.h"
#include "rgbd_graphslam/report/run_report.h"
#include "truth_comparison.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;

std::string pathOf(const CameralessRun& run, const std::string& name) {
    return run.job.out_folder + "/" + name;
}

/** What only runs with a camera write. */
void removeMapsOfEarlierRun(const CameralessRun& run) {
    std::error_code ignored;
    for (const char* name : {"map.sparse", "octree.bt", "octree.ot", "mesh.ply", "map3d.jpg",
                             "keyframes.jpg", "checkpoint"}) {
        fs::remove(pathOf(run, name), ignored);
    }
    if (run.report.loops.empty()) fs::remove(pathOf(run, "keyframes_before_loops.txt"), ignored);
    if (run.truth.empty()) fs::remove(pathOf(run, "truth.txt"), ignored);
}

double pathLength(const Trajectory& trajectory) {
    double length = 0;
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
        length += (trajectory[i].T_world_cam.t - trajectory[i - 1].T_world_cam.t).norm();
    }
    return length;
}

void describeFrames(CameralessRun& run) {
    JobReport& report = run.report;
    report.frames = run.frames.size();
    for (const TrackedFrame& frame : run.frames) {
        report.tracked += frame.origin == FrameOrigin::Tracked;
        report.dead_reckoned += frame.origin == FrameOrigin::DeadReckoned;
        report.lost += frame.origin == FrameOrigin::Lost;
    }
    report.keyframes = run.keyframes.size();
    report.path_m = pathLength(run.trajectory);
    report.quality = frameQuality(run.frames);
}

void describeEdges(const Trajectory& truth, CameralessRun& run) {
    JobReport& report = run.report;
    std::vector<PoseEdge> loops;
    for (const PoseEdge& edge : run.edges) {
        if (edge.kind == EdgeKind::Covisibility) report.covisibility_edges.push_back(edge);
        if (edge.kind != EdgeKind::Loop) continue;
        loops.push_back(edge);
        report.loops.push_back({edge.from, edge.to, edge.inliers,
                                edgeErrorM(edge, run.keyframes[edge.from].stamp_s,
                                           run.keyframes[edge.to].stamp_s, truth)});
    }
    std::vector<KeyframeView> views(run.keyframes.size());
    for (std::size_t k = 0; k < views.size(); ++k) {
        views[k].T_world_cam = run.keyframes[k].T_world_cam;
    }
    report.quality.loops = loopResiduals(loops, views);
    if (loops.empty()) run.keyframes_before_loops.clear();
    if (truth.empty()) return;
    report.false_loops = std::count_if(
        report.loops.begin(), report.loops.end(),
        [](const ReportedLoop& loop) { return loop.error_m && *loop.error_m > false_loop_m; });
}

void compare(const Trajectory& truth, CameralessRun& run) {
    const auto comparison = compareWithTruth(run.trajectory, truth);
    if (!comparison) return;
    run.report.ate_rmse_m = comparison->ate.translation_m.rmse;
    run.report.ate_pairs = comparison->ate.pairs.size();
    run.report.ate_fitted_scale = comparison->ate.fitted_scale;
    run.truth = comparison->truth;
}

void writePoses(const CameralessRun& run) {
    const auto write = [&](const char* name, const Trajectory& poses) {
        if (!poses.empty()) writeTextAtomically(pathOf(run, name), toTumText(poses));
    };
    write("trajectory.txt", run.trajectory);
    write("keyframes.txt", run.keyframes);
    write("keyframes_before_loops.txt", run.keyframes_before_loops);
    write("truth.txt", run.truth);
    writeTextAtomically(pathOf(run, "frames.csv"), framesCsv(run.frames));
    writeTextAtomically(pathOf(run, "frame_times.csv"), frameTimesCsv(run.report.frame_times));
    writeTextAtomically(pathOf(run, "covisibility.csv"),
                        covisibilityCsv(run.report.covisibility_edges));
}

void writeGraph(const CameralessRun& run) {
    KeyframeGraph graph;
    graph.root = 0;
    for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
        static_cast<mrpt::poses::CPose3D&>(graph.nodes[k]) =
            toCPose3D(run.keyframes[k].T_world_cam);
    }
    for (const PoseEdge& edge : run.edges) {
        graph.insertEdge(edge.from, edge.to, robotEdge(edge, SE3()));
    }
    writeAtomically(pathOf(run, "graph.graph"), [&](const std::string& temporary) {
        graph.saveToTextFile(temporary);
        return true;
    });
}

MapInputs mapInputs(const CameralessRun& run) {
    MapInputs inputs;
    inputs.rawlog = run.job.rawlog;
    inputs.keyframes = run.keyframes;
    inputs.trajectory = run.trajectory;
    for (const ReportedLoop& loop : run.report.loops) {
        inputs.loops.push_back({loop.from, loop.to, loop.inliers});
    }
    return inputs;
}

/** Ends of all beams, at the scanner's height, one per cell of the given size. */
PointMap pointsOf(const CameralessRun& run, double cell_m) {
    constexpr std::array<std::uint8_t, 3> ink{225, 225, 215};
    std::vector<std::pair<std::pair<long, long>, MapPoint>> points;
    for (std::size_t k = 0; k < run.beams.size(); ++k) {
        const auto z = static_cast<float>(run.scans[k]->sensorPose.z());
        for (const Eigen::Vector2d& end : run.beams[k].ends) {
            points.push_back({{std::lround(end.x() / cell_m), std::lround(end.y() / cell_m)},
                              {{float(end.x()), float(end.y()), z}, ink}});
        }
    }
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(points.begin(), points.end(), before);
    PointMap map;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == 0 || points[i].first != points[i - 1].first) map.push_back(points[i].second);
    }
    return map;
}

mrpt::maps::CSimpleMap simpleMap(const CameralessRun& run) {
    mrpt::maps::CSimpleMap map;
    for (std::size_t k = 0; k < run.scans.size(); ++k) {
        const auto pose = mrpt::poses::CPose3DPDFGaussian::Create(
            toCPose3D(run.keyframes[k].T_world_cam), mrpt::math::CMatrixDouble66());
        const auto frame = mrpt::obs::CSensoryFrame::Create();
        frame->insert(run.scans[k]);
        map.insert(pose, frame);
    }
    return map;
}

/** Viewers draw keyframes as what cameras see: the robot is drawn as one that looks ahead. */
mrpt::opengl::COpenGLScene sceneOf(const CameralessRun& run, const PointMap& points) {
    MapInputs inputs = mapInputs(run);
    for (StampedPose& keyframe : inputs.keyframes) {
        keyframe.T_world_cam = keyframe.T_world_cam * T_optical_from_mrpt.inverse();
    }
    Intrinsics flat;
    flat.width = 64;
    flat.height = 8;
    flat.fx = flat.fy = 32;
    flat.cx = 31.5;
    flat.cy = 3.5;
    return makeScene(inputs, points, CameraModel(flat));
}

void writeMaps(const CameralessRun& run) {
    const MapOptions& options = run.job.options.maps;
    ScanGrid beams(options.grid_resolution_m);
    for (const ScanBeams& scan : run.beams) beams.insert(scan);
    mrpt::maps::COccupancyGridMap2D grid;
    beams.build(grid, options.memory_limit_mb);
    saveMrptObject(pathOf(run, "grid.gridmap.gz"), grid);
    saveRosGrid(pathOf(run, "grid"), grid);
    const PointMap points = pointsOf(run, options.point_voxel_m);
    savePly(pathOf(run, "points.ply"), points);
    savePcd(pathOf(run, "points.pcd"), points);
    saveMetricMap(pathOf(run, "points.metricmap"), points);
    saveMrptObject(pathOf(run, "map.simplemap"), simpleMap(run));
    saveMrptObject(pathOf(run, "scene.3Dscene"), sceneOf(run, points));
    const cv::Mat picture = planView(mapInputs(run), points);
    writeAtomically(pathOf(run, "map.png"),
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
}

/** Of a map made without GPS, by its fixes. */
void georeference(const SensorLog& log, CameralessRun& run) {
    if (run.georeference || log.fixes.empty()) return;
    const GpsLog gps = gpsLog(log, run.job.options.gps);
    std::vector<PlacePair> pairs;
    if (gps.fixes.empty()) return;
    const LocalTangentPlane plane(gps.fixes.front().place);
    for (const GpsFix& fix : gps.fixes) {
        const auto pose = poseAt(run.trajectory, fix.stamp_s, 1.0);
        if (!pose) continue;
        pairs.push_back({*pose * gps.lever_arm, plane.toEnu(fix.place), fix.sigma_m.x()});
    }
    const auto T_enu_world = alignLevel(pairs);
    if (!T_enu_world) {
        sayWarning("GPS does not tell where the map lies: it has few fixes, or all within 5 m");
        return;
    }
    run.georeference = {plane.toGeodetic(T_enu_world->t),
                        std::atan2(T_enu_world->R(1, 0), T_enu_world->R(0, 0))};
}

void writeGeoreference(const CameralessRun& run) {
    std::error_code ignored;
    if (!run.georeference) {
        fs::remove(pathOf(run, georeference_name), ignored);
        return;
    }
    writeTextAtomically(pathOf(run, georeference_name), toYaml(*run.georeference));
}

}  // namespace

SensorFigures figuresOf(const std::string& label, const std::string& class_name,
                        const std::vector<double>& stamps_s) {
    SensorFigures figures;
    figures.label = label;
    figures.class_name = class_name;
    figures.readings = stamps_s.size();
    for (std::size_t i = 1; i < stamps_s.size(); ++i) {
        figures.longest_gap_s = std::max(figures.longest_gap_s, stamps_s[i] - stamps_s[i - 1]);
    }
    const double duration_s = stamps_s.empty() ? 0 : stamps_s.back() - stamps_s.front();
    if (duration_s > 0) {
        figures.rate_hz = static_cast<double>(stamps_s.size() - 1) / duration_s;
    }
    return figures;
}

void writeCameraless(const SensorLog& log, CameralessRun& run) {
    describeFrames(run);
    describeEdges(log.truth, run);
    compare(log.truth, run);
    writeTextAtomically(pathOf(run, "config.ini"), configText(run.job.options));
    writePoses(run);
    writeGraph(run);
    georeference(log, run);
    writeGeoreference(run);
    const ThreadClock clock;
    if (run.job.options.run.dense_maps && !run.scans.empty()) writeMaps(run);
    run.report.maps_wall_s = 1e-3 * clock.wallMs();
    run.report.peak_memory_mb = peakMemoryMb();
    run.report.warnings = run.warnings.warnings();
    writeTextAtomically(pathOf(run, "summary.json"), summaryJson(run.job, run.report));
    removeMapsOfEarlierRun(run);
    writeRunReport(run.job.out_folder, run.job.out_folder);
}

}  // namespace rgbd_graphslam
