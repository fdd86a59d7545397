#include "rgbd_graphslam/navigation/drive_job.h"

#include <mrpt/config/CConfigFile.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/navigation/clearance.h"
#include "rgbd_graphslam/navigation/drive_report.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

using mrpt::math::TPose2D;

/** Gone with all that is in it at the end. */
class ScratchFolder {
  public:
    ScratchFolder() : path_((fs::temp_directory_path() / "rgbd-drive-XXXXXX").string()) {
        if (!mkdtemp(path_.data()))
            throw Error("cannot make a folder in '" + fs::temp_directory_path().string() + "'",
                        "set TMPDIR to one that can be written");
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

double millisecondsOf(const std::function<void()>& job) {
    const auto start = std::chrono::steady_clock::now();
    job();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

DriveOptions readOptions(const DriveRequest& request) {
    DriveOptions options;
    IniFile::fromFile(request.ini).loadKnown({&options});
    IniFile overrides = IniFile::fromText("", "command line");
    for (const auto& setting : request.settings) overrides.override(setting);
    overrides.load({&options});
    return options;
}

TPose2D belowFirstCamera(const Trajectory& trajectory) {
    const SE3& T = trajectory.front().T_world_cam;
    return {T.t.x(), T.t.y(), std::atan2(T.R(1, 2), T.R(0, 2))};
}

std::string inFolder(const std::string& folder, const char* name) {
    return (fs::path(folder) / name).string();
}

std::vector<mrpt::math::TPoint2D> waypointsOf(const Route& route,
                                              const std::vector<TPose2D>& motion,
                                              const std::string& follow) {
    if (follow == "route") return route;
    std::vector<mrpt::math::TPoint2D> waypoints;
    for (std::size_t i = 1; i < motion.size(); ++i) waypoints.push_back({motion[i].x, motion[i].y});
    waypoints.push_back(route.back());
    return waypoints;
}

/** One a pose of the path; none when the truth is not known. */
std::vector<double> clearancesOf(const DriveRequest& request, const Trajectory& trajectory,
                                 const Drive& drive, const RobotBody& body,
                                 double body_clearance_m) {
    std::vector<double> clearances;
    if (request.surface.empty()) return clearances;
    const SE3 T_truth_map =
        evaluateAte(trajectory, readTumTrajectory(request.truth)).alignment.motion;
    const TrueObstacles obstacles(readPly(request.surface), body, body_clearance_m);
    for (const DrivenPose& driven : drive.path)
        clearances.push_back(obstacles.clearance(inTruth(T_truth_map, driven.pose)));
    return clearances;
}

void write(const std::string& folder, const std::string& csv, const cv::Mat& picture) {
    makeWritableFolder(folder);
    writeTextAtomically(inFolder(folder, "path.csv"), csv);
    writeAtomically(inFolder(folder, "drive.png"),
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
}

}  // namespace

DriveSummary runDrive(const DriveRequest& request) {
    if (request.surface.empty() != request.truth.empty())
        throw Error("--surface and --truth belong together", "give both or none");
    const DriveOptions options = readOptions(request);
    const mrpt::config::CConfigFile config(request.ini);
    const RobotBody body = readRobotBody(config);
    const NavigationMap map = loadNavigationMap(request.run_folder, options, body.back().high_m);
    const Trajectory trajectory = readTumTrajectory(inFolder(request.run_folder, "trajectory.txt"));
    const TPose2D start = request.start ? *request.start : belowFirstCamera(trajectory);
    const double radius_m = circumscribedRadius(body) + options.planning_margin_m;
    requireFree(map.grid, {start.x, start.y}, radius_m, "start");
    requireFree(map.grid, request.goal, radius_m, "goal");

    const ScratchFolder cache;
    DriveSummary summary;
    Route route;
    summary.route_ms = millisecondsOf([&] {
        route = planRoute(map.grid, {start.x, start.y}, request.goal, radius_m);
    });
    const TPose2D turned(start.x, start.y, firstHeading(start, route));
    std::vector<TPose2D> motion;
    summary.motion_ms = millisecondsOf(
        [&] { motion = planMotion(map, turned, route, body, options, config, cache.path()); });
    const Drive drive =
        driveAlong(map, start, turned.phi, waypointsOf(route, motion, options.follow), options,
                   config, cache.path());
    const auto clearances =
        clearancesOf(request, trajectory, drive, body, options.body_clearance_m);

    summary.arrived = drive.arrived;
    summary.why_not = drive.why_not;
    summary.route_points = route.size();
    summary.motion_poses = motion.size();
    summary.driven_m = drive.length_m();
    summary.duration_s = drive.duration_s();
    if (!clearances.empty())
        summary.least_clearance_m = *std::min_element(clearances.begin(), clearances.end());
    write(request.out_folder.empty() ? request.run_folder : request.out_folder,
          pathCsv(drive, clearances), drivePicture(map, route, motion, drive, body));
    return summary;
}

std::string toText(const DriveSummary& summary) {
    char text[512];
    std::snprintf(text, sizeof(text),
                  "arrived        %s\nroute          %zu points in %.1f ms\n"
                  "motion         %zu poses in %.0f ms\ndriven         %.2f m in %.1f s\n",
                  summary.arrived ? "yes" : ("no: " + summary.why_not).c_str(),
                  summary.route_points, summary.route_ms, summary.motion_poses, summary.motion_ms,
                  summary.driven_m, summary.duration_s);
    std::string lines = text;
    if (summary.least_clearance_m) {
        std::snprintf(text, sizeof(text), "clearance      %.3f m at least%s\n",
                      *summary.least_clearance_m,
                      *summary.least_clearance_m > 0 ? "" : ": collision");
        lines += text;
    }
    return lines;
}

}  // namespace rgbd_graphslam
