/** What a run's output folder tells about it. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** The origin of a frame's pose as frames.csv names it. */
enum class FrameState { Tracked, Recovered, DeadReckoned, Uncertain, Lost };

/** A line of frames.csv. */
struct ReportedFrame {
    double seconds = 0;  // since the first frame
    FrameState state = FrameState::Tracked;
    int inliers = 0;  // landmarks that agreed with the pose
    bool keyframe = false;
};

/** CPU milliseconds a call. */
struct StageRecord {
    std::string name;
    std::size_t calls = 0;
    double mean_ms = 0, median_ms = 0, p95_ms = 0, max_ms = 0;
};

/** A loop edge as summary.json tells it. */
struct LoopRecord {
    int from = 0, to = 0;  // keyframes
    int inliers = 0;
    /** Of the measured place of one camera from the other against the truth, where it is known. */
    std::optional<double> error_m;
};

/** What was run, when and with which camera; empty of runs of earlier versions. */
struct RunOrigin {
    std::string command, date;
    std::optional<Intrinsics> camera;
};

/** What summary.json says of a run's quality without ground truth; what is missing there, because
 *  it is not known or the run is of an earlier version, is nothing here. */
struct QualityRecord {
    std::optional<double> inliers_median, inliers_p05;
    /** Share of a keyframe's pixels, 0 to 1. */
    std::optional<double> depth_median, depth_p05;
    std::optional<double> spread_median_mm, spread_p95_mm;
    std::optional<double> loop_median_mm, loop_max_mm, loop_median_deg, loop_max_deg;
    std::optional<double> drift_gap_m, drift_path_m;
};

/** What a sensor gave to the estimate, as summary.json tells it. */
struct SensorUse {
    std::string label, class_name, use;
    std::size_t readings = 0, used = 0;
    double rate_hz = 0, longest_gap_s = 0;
    /** Root mean square of the residuals: m, and over their standard deviations. */
    std::optional<double> residual_m, whitened;
};

/** What summary.json says of inertial sensor and wheels, as figures and what they mean. */
struct MotionFigure {
    std::string sensor, figure, value;
};

/** All that the report needs of an output folder. */
struct RunRecord {
    RunOrigin origin;
    std::string rawlog, version, config_hash;
    bool interrupted = false;
    std::string damage;                 // why the rawlog ended early; empty when it did not
    std::vector<std::string> warnings;  // said during the run
    std::size_t out_of_order = 0, landmarks = 0, culled_keyframes = 0;
    double path_m = 0, frames_per_s = 0, cpu_ms_a_frame = 0, maps_wall_s = 0, peak_memory_mb = 0;
    double start_s = 0;  // stamp of the first frame
    /** As the run has told it, by the true poses nearest in time; nothing without truth. */
    std::optional<double> ate_rmse_m;
    std::vector<ReportedFrame> frames;
    std::vector<StageRecord> stages;
    std::vector<LoopRecord> loops;
    QualityRecord quality;
    std::vector<SensorUse> sensors;
    /** Empty without such sensors and of runs of earlier versions. */
    std::vector<MotionFigure> motion;
    /** How many have an error that only a wrong place explains; nothing without truth. */
    std::optional<std::size_t> false_loops;

    /** Camera poses in the map's frame, z up. */
    Trajectory trajectory, keyframes;
    Trajectory keyframes_before_loops;  // empty without loops
    /** Numbers of keyframes of earlier sessions; paths are not drawn from one to the next. */
    std::vector<std::size_t> earlier_keyframes;
    Trajectory truth;  // empty where it is not known

    /** Pictures as files hold them; empty where there are none. */
    std::string map_png, map3d_jpg, grid_png, keyframes_jpg;

    std::size_t count(FrameState state) const;
};

/** \param run_folder of rgbd-slam
 *  \param map_folder where map.png and grid.png are
 *  \throws Error naming the file that is missing or makes no sense */
RunRecord readRunRecord(const std::string& run_folder, const std::string& map_folder);

}  // namespace rgbd_graphslam
