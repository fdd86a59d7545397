#include "cameraless_job.h"

#include "cameraless_run.h"
#include "gps_job.h"
#include "laser_job.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "rgbd_graphslam/core/thread_clock.h"

namespace rgbd_graphslam {
namespace {

void checkWishes(const SlamJob& job) {
    if (!job.map_folder.empty()) {
        throw Error("'" + job.rawlog + "' has no camera: --map needs RGB-D frames",
                    "leave --map out to make a map of its own");
    }
    if (job.view) sayWarning("--view shows RGB-D runs only; open the finished run instead");
}

void tellOfOrder(const SensorLog& log) {
    if (log.scans_out_of_order > 0) {
        sayWarning(std::to_string(log.scans_out_of_order) +
                   " scans are not later than the one before and are left out");
    }
    if (log.others_out_of_order > 0) {
        sayWarning(std::to_string(log.others_out_of_order) +
                   " readings of wheels, IMU or GPS are not later than the one before and are left "
                   "out");
    }
}

}  // namespace

std::optional<JobReport> runWithoutCamera(const SlamJob& job) {
    const CameralessKind kind = cameralessKind(job.rawlog);
    if (kind == CameralessKind::None) return std::nullopt;
    checkWishes(job);
    CameralessRun run;
    run.job = job;
    const ThreadClock clock;
    const double cpu_before = processCpuSeconds();
    const SensorLog log = readSensorLog(job.rawlog, job.sensor_label);
    tellOfOrder(log);
    makeWritableFolder(job.out_folder);
    if (kind == CameralessKind::Laser) {
        mapByLaser(log, run);
    } else {
        fuseWithGps(log, run);
    }
    run.report.sensors = log.sensors;
    run.report.damage = log.damage;
    run.report.out_of_order = log.scans_out_of_order;
    run.report.tracking_wall_s = 1e-3 * clock.wallMs();
    run.report.tracking_cpu_s = processCpuSeconds() - cpu_before;
    writeCameraless(log, run);
    return run.report;
}

}  // namespace rgbd_graphslam
