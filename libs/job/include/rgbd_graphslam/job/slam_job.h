/** The main job: a rawlog in, a folder with trajectory, graph and maps out. */
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/input/live_source.h"
#include "rgbd_graphslam/input/sensor_census.h"
#include "rgbd_graphslam/job/job_options.h"
#include "rgbd_graphslam/job/run_quality.h"
#include "rgbd_graphslam/mapping/map_builder.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** What to run on, with which settings, and where to write. */
struct SlamJob {
    std::string rawlog, out_folder;
    /** Sensors that run now, in place of a recording; null = a recording. `rawlog` then is the
     *  record of the run, which the maps are made of; it exists if `live` records to it. */
    std::shared_ptr<LiveSource> live;
    JobOptions options;
    /** Output folder of an earlier run whose map this one starts from; empty = a map of its own. */
    std::string map_folder;
    MapUse map_use = MapUse::Localize;
    /** Starts rgbd-viewer beside the run. */
    bool view = false;
    /** Goes on from the checkpoint in the output folder; see resumedJob(). */
    bool resume = false;
    /** Of the RGB-D camera to track; empty = the one whose frame comes first. */
    std::string sensor_label;
    /** Refuses a recording whose map would be wrong, in place of a warning. */
    bool strict = false;

    bool localizes() const { return !map_folder.empty() && map_use == MapUse::Localize; }
};

/** How long a frame took from its features to its pose and all that it set off. */
struct FrameTime {
    double stamp_s = 0, wall_ms = 0;
};

/** A loop edge with a larger error joins places that are not the same. */
inline constexpr double false_loop_m = 0.2;

/** A loop edge of the graph, between two keyframes. */
struct ReportedLoop {
    int from = 0, to = 0;
    int inliers = 0;
    /** How far the measured place of one camera in the other is from the true one; nothing where
     * the truth of either is not known. */
    std::optional<double> error_m;
};

/** What a sensor gave to the estimate. */
struct SensorFigures {
    std::string label, class_name;
    std::size_t readings = 0, used = 0;
    double rate_hz = 0, longest_gap_s = 0;
    /** Root mean square of the residuals, m, and of the same over their standard deviations: 1 is
     *  what is expected. Nothing where the sensor has no residuals. */
    std::optional<double> residual_m, whitened;
    /** What it was used for, in words. */
    std::string use;
};

/** What came of a job. */
struct JobReport {
    std::size_t frames = 0, tracked = 0, recovered = 0, dead_reckoned = 0, uncertain = 0, lost = 0;
    /** With a pose, but in a submap whose place is unknown; they count above, too. */
    std::size_t disconnected = 0;
    /** Frames left out because their stamp was not later than the one before. */
    std::size_t out_of_order = 0;
    std::size_t keyframes = 0, culled_keyframes = 0, landmarks = 0;
    std::vector<ReportedLoop> loops;
    /** Of the loops whose error is known, those beyond false_loop_m; nothing without truth. */
    std::optional<std::size_t> false_loops;
    std::vector<PoseEdge> covisibility_edges;
    /** All that the rawlog holds, as far as it was read. */
    std::vector<SensorRecord> sensors;
    /** Of the sensors that were used, where it was measured. */
    std::vector<SensorFigures> sensor_figures;
    RunQuality quality;
    MotionSummary motion;
    /** Of the gyroscope's stamps; nothing where the camera hardly turned. */
    std::optional<StampDelay> imu_delay;
    /** In such parts. */
    std::vector<int> disconnected_keyframes;
    /** Of a map that was extended. */
    std::vector<EarlierSession> earlier;
    /** Of the map; nothing where none was written. */
    std::optional<Intrinsics> camera;
    double path_m = 0;
    /** Against the rawlog's ground truth, where it has one. */
    std::optional<double> ate_rmse_m;
    std::size_t ate_pairs = 0;
    /** Factor on the positions with which they would fit the truth best. */
    std::optional<double> ate_fitted_scale;

    /** From the first frame to the last: wall time, and CPU time of all threads. */
    double tracking_wall_s = 0, tracking_cpu_s = 0;
    double maps_wall_s = 0;
    double peak_memory_mb = 0;
    std::vector<VisualSlam::StageTime> stages;
    std::vector<FrameTime> frame_times;
    /** Of a run over live sensors. */
    std::optional<LiveStatistics> live;

    /** Said on the way. */
    std::vector<std::string> warnings;
    bool interrupted = false;
    /** Why the job ended before the rawlog did, naming the frame; empty when it did not. */
    std::string damage;
    /** Which of RunOptions' limits ended the tracking, and where; empty when none did. */
    std::string limit;

    double framesPerSecond() const { return tracking_wall_s > 0 ? frames / tracking_wall_s : 0; }
    double cpuMsAFrame() const { return frames > 0 ? 1e3 * tracking_cpu_s / frames : 0; }
};

/** Runs SLAM over the whole rawlog and writes the folder: trajectory.txt, frames.csv,
 *  frame_times.csv, keyframes.txt, covisibility.csv, graph.graph, config.ini, the maps unless
 * switched off, summary.json, and report.html made of them. All poses are of the camera's optical
 * frame (in the graph: of the robot) in a world with z up and the floor at 0. The trajectory is
 * byte-identical for any number of threads.
 *
 *  From an earlier run's map: all poses are in that run's world. Localizing writes the trajectory
 *  only, never into the map's own folder; extending writes everything, of both runs, but
 *  trajectory.txt and frames.csv have the frames of this rawlog.
 *
 *  After every so many keyframes a checkpoint is written into the folder, and removed at the end. A
 *  run that goes on from it reads over what was tracked and ends with the same trajectory, graph,
 *  frames.csv and maps as one that was never ended; times of stages are of what it tracked itself.
 *  A run that localizes writes none.
 *
 *  A live run goes on until its source ends or somebody interrupts, and writes no checkpoints. Its
 *  maps need the record. A run over the record writes the same trajectory, graph, frames.csv and
 *  maps.
 *
 *  A rawlog that is cut off or damaged, SIGINT or SIGTERM, and the limits on keyframes and memory
 *  end the tracking; what was mapped by then is written and the report says so.
 *  A rawlog without a camera but with a 2-D laser scanner is mapped by laser and odometry; one with
 *  GPS instead is a fusion of wheels, IMU and GPS. Poses are then of the robot's base, and there
 * are no 3-D maps and no checkpoints. Of the settings, what is left open
 * (FeatureOptions::depth_max_m = 0) is decided by the first frames and written as decided. What
 * looks wrong about them is warned of; a strict job refuses it. \throws Error when the rawlog has
 * no RGB-D frame, a strict job finds it wrong, nothing could be mapped or located, the earlier map
 * cannot be read or does not fit, or the folder cannot be written */
JobReport runSlamJob(const SlamJob& job);

/** What the run in a folder was doing when it was killed or interrupted.
 *  \throws Error when there is no checkpoint, it is damaged, another version of the program wrote
 * it, or the rawlog is not the one that it was written for */
SlamJob resumedJob(const std::string& out_folder);

/** A few lines for people. */
std::string resultTable(const SlamJob& job, const JobReport& report);

/** Mean, median, 95th percentile and maximum of every stage, in ms of CPU and wall time. */
std::string profileTable(const JobReport& report);

}  // namespace rgbd_graphslam
