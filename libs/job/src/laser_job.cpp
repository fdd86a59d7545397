#include "laser_job.h"

#include <algorithm>
#include <cmath>

#include "interruption.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/laser/aperture_check.h"
#include "rgbd_graphslam/laser/laser_slam.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

/** \throws Error naming what is wrong with all scans */
void checkScans(const SensorLog& log, const SlamJob& job) {
    const auto& first = *log.scans.front();
    const std::string problem = mountingProblem(first);
    if (!problem.empty()) {
        throw Error(problem + ": its scans are no floor plan",
                    "correct sensorPose in '" + job.rawlog + "'");
    }
    const LaserOptions& options = job.options.laser;
    const bool any = std::any_of(log.scans.begin(), log.scans.end(), [&](const auto& scan) {
        return !toPlanarScan(*scan, options.min_range_m, options.max_range_m).points.empty();
    });
    if (any) return;
    throw Error(formatted("none of the %zu scans of '%s' in '%s' has a reading between %g and %g m "
                          "and below the scanner's maximum of %g m",
                          log.scans.size(), first.sensorLabel.c_str(), job.rawlog.c_str(),
                          options.min_range_m, options.max_range_m, first.maxRange),
                "check the unit of the ranges, or [LaserOptions]");
}

/** Corrects what the scans are recorded with where they prove it wrong. */
void correctAperture(const SensorLog& log) {
    std::vector<PlacedScan> placed;
    for (const auto& scan : log.scans) {
        const auto pose = wheelPoseAt(log.wheels, toSeconds(scan->timestamp));
        if (pose) placed.push_back({scan, *pose});
    }
    if (placed.empty()) return;
    const ApertureVerdict verdict = checkAperture(placed);
    sayDetail(formatted("scans turn %.2f times as far as the odometry", verdict.turn_ratio));
    if (!verdict.warning.empty()) sayWarning(verdict.warning);
    for (const auto& scan : log.scans) scan->aperture *= static_cast<float>(verdict.factor);
}

void tellOfOdometry(const SensorLog& log, std::size_t without) {
    if (log.wheels.empty()) {
        sayWarning(
            "no odometry: the motion between scans is carried on from the scans before, which "
            "loses the way along bare corridors");
    } else if (without > 0) {
        sayWarning(std::to_string(without) + " scans have no odometry within 0.5 s");
    }
}

void track(const SensorLog& log, LaserSlam& slam, CameralessRun& run) {
    const Interruption interruption;
    const LaserOptions& options = run.job.options.laser;
    const std::size_t limit = run.job.options.run.max_frames > 0
                                  ? static_cast<std::size_t>(run.job.options.run.max_frames)
                                  : log.scans.size();
    const std::size_t count = std::min(limit, log.scans.size());
    std::size_t without_odometry = 0;
    Progress progress("tracking", count, "scans");
    for (std::size_t i = 0; i < count && !interruption.requested(); ++i) {
        const ThreadClock clock;
        const PlanarScan scan =
            toPlanarScan(*log.scans[i], options.min_range_m, options.max_range_m);
        const auto odometry = wheelPoseAt(log.wheels, scan.stamp_s);
        without_odometry += !odometry;
        if (slam.add(scan, odometry).is_keyscan) run.scans.push_back(log.scans[i]);
        run.report.frame_times.push_back({scan.stamp_s, clock.wallMs()});
        progress.update(i + 1, std::to_string(slam.keyscans().size()) + " keyscans");
    }
    run.report.interrupted = interruption.requested();
    tellOfOdometry(log, without_odometry);
}

TrackedFrame frameOf(const TrackedScan& scan, const SE3& T_world_base) {
    TrackedFrame frame;
    frame.stamp_s = scan.stamp_s;
    frame.origin = scan.matched ? FrameOrigin::Tracked : FrameOrigin::DeadReckoned;
    frame.T_world_cam = T_world_base;
    frame.inliers = static_cast<int>(scan.inliers);
    if (scan.is_keyscan) frame.keyframe = scan.keyscan;
    return frame;
}

ScanBeams beamsOf(const Keyscan& keyscan) {
    ScanBeams beams;
    beams.origin = transformed(keyscan.T_world_base, keyscan.scan.origin);
    for (const ScanPoint& point : keyscan.scan.points) {
        beams.ends.push_back(transformed(keyscan.T_world_base, point.p));
    }
    return beams;
}

void collect(const LaserSlam& slam, CameralessRun& run) {
    for (const TrackedScan& scan : slam.scans()) {
        const SE3 T_world_base = toSE3(slam.poseOf(scan));
        run.trajectory.push_back({scan.stamp_s, T_world_base});
        run.frames.push_back(frameOf(scan, T_world_base));
    }
    for (const Keyscan& keyscan : slam.keyscans()) {
        run.keyframes.push_back({keyscan.scan.stamp_s, toSE3(keyscan.T_world_base)});
        run.keyframes_before_loops.push_back({keyscan.scan.stamp_s, toSE3(keyscan.T_tracked_base)});
        run.beams.push_back(beamsOf(keyscan));
    }
    run.edges = slam.edges();
}

SensorFigures laserFigures(const SensorLog& log, const LaserSlam& slam, double sigma_m) {
    std::vector<double> stamps_s;
    for (const auto& scan : log.scans) stamps_s.push_back(toSeconds(scan->timestamp));
    SensorFigures figures =
        figuresOf(log.scans.front()->sensorLabel, "CObservation2DRangeScan", stamps_s);
    double squares = 0;
    std::size_t aligned = 0;
    for (const TrackedScan& scan : slam.scans()) {
        figures.used += scan.matched;
        if (scan.rms_m <= 0) continue;
        squares += scan.rms_m * scan.rms_m;
        ++aligned;
    }
    if (aligned > 0) {
        figures.residual_m = std::sqrt(squares / static_cast<double>(aligned));
        figures.whitened = *figures.residual_m / sigma_m;
    }
    const auto& edges = slam.edges();
    const auto loops = std::count_if(edges.begin(), edges.end(), [](const PoseEdge& edge) {
        return edge.kind == EdgeKind::Loop;
    });
    figures.use = formatted("aligned to submaps; %zu keyscans, %td loops, %zu loops rejected",
                            slam.keyscans().size(), loops, slam.rejectedLoops());
    return figures;
}

/** How far the odometry is from the map, from keyscan to keyscan. */
std::string odometryText(const SensorLog& log, const LaserSlam& slam) {
    std::vector<double> shares, degrees;
    const auto& keyscans = slam.keyscans();
    for (std::size_t k = 1; k < keyscans.size(); ++k) {
        const auto from = wheelPoseAt(log.wheels, keyscans[k - 1].scan.stamp_s),
                   to = wheelPoseAt(log.wheels, keyscans[k].scan.stamp_s);
        if (!from || !to) continue;
        const PlanarPose moved = keyscans[k - 1].T_world_base.inverse() * keyscans[k].T_world_base;
        const PlanarPose off = (from->inverse() * *to).inverse() * moved;
        const double way_m = positionOf(moved).norm();
        if (way_m > 0.1) shares.push_back(100 * positionOf(off).norm() / way_m);
        degrees.push_back(std::abs(wrapped(off.yaw)) * 180 / M_PI);
    }
    if (shares.empty()) return "predicts the motion between scans";
    return formatted(
        "predicts the motion between scans; differs from the map by %.1f %% of the way and %.2f "
        "degrees per keyscan (medians)",
        percentileOf(shares, 0.5), percentileOf(degrees, 0.5));
}

void describeSensors(const SensorLog& log, const LaserSlam& slam, CameralessRun& run) {
    auto& figures = run.report.sensor_figures;
    figures.push_back(laserFigures(log, slam, run.job.options.laser.point_sigma_m));
    if (log.wheels.empty()) return;
    std::vector<double> stamps_s;
    for (const WheelSample& sample : log.wheels) stamps_s.push_back(sample.stamp_s);
    std::string label = "ODOMETRY";
    for (const SensorRecord& sensor : log.sensors) {
        if (sensor.used && sensor.class_name == "CObservationOdometry") label = sensor.label;
    }
    figures.push_back(figuresOf(label, "CObservationOdometry", stamps_s));
    figures.back().used = figures.back().readings;
    figures.back().use = odometryText(log, slam);
}

}  // namespace

void mapByLaser(const SensorLog& log, CameralessRun& run) {
    checkScans(log, run.job);
    correctAperture(log);
    LaserSlam slam(run.job.options.laser);
    run.scans.push_back(log.scans.front());
    track(log, slam, run);
    slam.finish();
    collect(slam, run);
    describeSensors(log, slam, run);
}

}  // namespace rgbd_graphslam
