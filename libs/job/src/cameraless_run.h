/** A run without a camera, and its output folder. */
#pragma once
#include <vector>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/fusion/gps_fusion.h"
#include "rgbd_graphslam/geometry/geodetic.h"
#include "rgbd_graphslam/input/sensor_log.h"
#include "rgbd_graphslam/job/slam_job.h"
#include "rgbd_graphslam/laser/scan_grid.h"

namespace rgbd_graphslam {

/** All poses are of the robot's base, in a world with z up. */
struct CameralessRun {
    SlamJob job;
    JobReport report;
    WarningRecord warnings;
    /** Of every scan or moment, and the nodes of the graph. */
    Trajectory trajectory, keyframes;
    Trajectory keyframes_before_loops;  // empty without loops
    Trajectory truth;                   // beside the estimate, in its world
    std::vector<TrackedFrame> frames;
    std::vector<PoseEdge> edges;
    /** Nothing where it is not known. */
    std::optional<GeoReference> georeference;
    /** Of each keyframe; empty where there is no scanner. */
    std::vector<ScanBeams> beams;
    /** The keyframes' scans. */
    std::vector<mrpt::obs::CObservation2DRangeScan::Ptr> scans;
};

/** Rate, gaps and number of a sensor's readings. \param stamps_s rising */
SensorFigures figuresOf(const std::string& label, const std::string& class_name,
                        const std::vector<double>& stamps_s);

/** GPS fixes of the log that can be used, and where the antenna is. */
struct GpsLog {
    std::vector<GpsFix> fixes;
    Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
    std::string label;
    std::size_t without_fix = 0;
};
GpsLog gpsLog(const SensorLog& log, const GpsOptions& options);

/** Completes the report and writes trajectory.txt, keyframes.txt, frames.csv, frame_times.csv,
 *  covisibility.csv, graph.graph, config.ini, summary.json and report.html, and georeference.yaml
 * where GPS tells it; where there are scans, the grid's files, points.ply, points.pcd,
 * points.metricmap, map.simplemap and map.png, unless maps are switched off. Maps of an earlier run
 * in the folder that this one does not make are removed. */
void writeCameraless(const SensorLog& log, CameralessRun& run);

}  // namespace rgbd_graphslam
