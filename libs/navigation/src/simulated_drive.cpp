#include "rgbd_graphslam/navigation/simulated_drive.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/kinematics/CVehicleSimul_DiffDriven.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/nav/reactive/CReactiveNavigationSystem3D.h>
#include <mrpt/nav/reactive/CRobot2NavInterfaceForSimulator.h>

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using mrpt::math::TPose2D;

/** What MRPT's navigator asks of a robot. Stamps are of the simulation's clock, so that a drive is
 *  the same however fast the computer is. */
class SimulatedRobot : public mrpt::nav::CRobot2NavInterfaceForSimulator_DiffDriven {
  public:
    SimulatedRobot(const NavigationMap& map, const TPose2D& start, const DriveOptions& options)
        : CRobot2NavInterfaceForSimulator_DiffDriven(vehicle_), map_(map), options_(options) {
        setMinLoggingLevel(mrpt::system::LVL_ERROR);
        vehicle_.setDelayModelParams(options.motor_lag_s, 0);
        vehicle_.setCurrentGTPose(start);
        vehicle_.setCurrentOdometricPose(start);
    }

    bool getCurrentPoseAndSpeeds(TPose2D& pose, mrpt::math::TTwist2D& velocity,
                                 mrpt::system::TTimeStamp& stamp, TPose2D& odometry,
                                 std::string&) override {
        pose = odometry = vehicle_.getCurrentGTPose();
        velocity = vehicle_.getCurrentGTVel();
        stamp = now();
        return true;
    }

    bool senseObstacles(mrpt::maps::CSimplePointsMap& seen,
                        mrpt::system::TTimeStamp& stamp) override {
        seen.clear();
        stamp = now();
        for (const MapPoint& point : map_.obstacles)
            sense(point.position.x(), point.position.y(), point.position.z(), seen);
        // Without them the robot would take what was never seen for free.
        for (const auto& p : map_.borders)
            sense(p.x, p.y, static_cast<float>(options_.floor_clearance_m), seen);
        return true;
    }

    void sendApparentCollisionEvent() override { touched_ = true; }
    void sendNavigationEndEvent() override { arrived_ = true; }
    void sendWaySeemsBlockedEvent() override { blocked_ = true; }

    void turn(double rad_s) { vehicle_.movementCommand(0, rad_s); }
    void pass(double seconds) { vehicle_.simulateOneTimeStep(seconds); }
    DrivenPose state() const {
        const auto velocity = vehicle_.getCurrentGTVelLocal();
        return {vehicle_.getTime(), vehicle_.getCurrentGTPose(), velocity.vx, velocity.omega};
    }
    bool arrived() const { return arrived_; }
    bool blocked() const { return blocked_; }
    bool touched() const { return touched_; }

  private:
    void sense(double x, double y, float z, mrpt::maps::CSimplePointsMap& seen) const {
        const TPose2D& pose = vehicle_.getCurrentGTPose();
        const mrpt::math::TPoint2D p = pose.inverseComposePoint({x, y});
        if (p.norm() < options_.sensor_range_m)
            seen.insertPoint(static_cast<float>(p.x), static_cast<float>(p.y), z);
    }

    mrpt::system::TTimeStamp now() const {
        return mrpt::Clock::fromDouble(1e9 + vehicle_.getTime());
    }

    mrpt::kinematics::CVehicleSimul_DiffDriven vehicle_;
    const NavigationMap& map_;
    const DriveOptions& options_;
    bool arrived_ = false, blocked_ = false, touched_ = false;
};

mrpt::nav::TWaypointSequence toSequence(const std::vector<mrpt::math::TPoint2D>& waypoints,
                                        const DriveOptions& options) {
    mrpt::nav::TWaypointSequence sequence;
    for (const auto& p : waypoints) {
        sequence.waypoints.emplace_back(p.x, p.y, options.waypoint_radius_m, true);
    }
    sequence.waypoints.back().allowed_distance = options.goal_radius_m;
    sequence.waypoints.back().speed_ratio = 0;
    return sequence;
}

/** The line that tells of an exception of MRPT's, which comes with a stack trace. */
std::string messageOf(const std::string& what) {
    const std::string mark = "Message:";
    const auto at = what.find(mark);
    if (at == std::string::npos) return what.substr(0, what.find('\n'));
    const auto begin = what.find_first_not_of(' ', at + mark.size());
    return what.substr(begin, what.find('\n', begin) - begin);
}

/** MRPT's navigator without its talk on the console. */
class Navigator : public mrpt::nav::CReactiveNavigationSystem3D {
  public:
    Navigator(SimulatedRobot& robot, const mrpt::config::CConfigFileBase& config,
              const std::string& cache_folder)
        : CReactiveNavigationSystem3D(robot, false) {
        logging_enable_console_output = false;
        m_timlog_delays.disable();
        enableRethrowNavExceptions(true);
        loadConfigFile(config);
        params_abstract_ptg_navigator.ptg_cache_files_directory = cache_folder;
        initialize();
    }
};

/** On the spot, until the robot looks that way or the drive's time is over. */
std::vector<DrivenPose> turn(SimulatedRobot& robot, double heading_rad,
                             const DriveOptions& options) {
    constexpr double close_rad = 0.05, fastest_rad_s = 0.8, gain_hz = 1.5;
    std::vector<DrivenPose> path{robot.state()};
    while (path.back().time_s < options.time_limit_s) {
        const double left = mrpt::math::wrapToPi(heading_rad - path.back().pose.phi);
        if (std::abs(left) < close_rad) break;
        robot.turn(std::clamp(gain_hz * left, -fastest_rad_s, fastest_rad_s));
        robot.pass(options.control_period_s);
        path.push_back(robot.state());
    }
    robot.turn(0);
    return path;
}

/** Until the navigator has arrived or given up. */
void follow(SimulatedRobot& robot, Navigator& navigator, const DriveOptions& options,
            Drive& drive) {
    while (drive.duration_s() < options.time_limit_s && !robot.blocked()) {
        navigator.navigationStep();
        if (navigator.getCurrentState() != Navigator::NAVIGATING) break;
        robot.pass(options.control_period_s);
        drive.path.push_back(robot.state());
    }
    drive.arrived = robot.arrived();
    if (drive.arrived) return;
    drive.why_not =
        robot.blocked() ? "the way seems blocked" : navigator.getErrorReason().error_msg;
    if (drive.why_not.empty()) drive.why_not = "too far for time_limit_s";
}

}  // namespace

double Drive::length_m() const {
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        length +=
            std::hypot(path[i].pose.x - path[i - 1].pose.x, path[i].pose.y - path[i - 1].pose.y);
    }
    return length;
}

Drive driveAlong(const NavigationMap& map, const TPose2D& start, double first_heading_rad,
                 const std::vector<mrpt::math::TPoint2D>& waypoints, const DriveOptions& options,
                 const mrpt::config::CConfigFileBase& config, const std::string& cache_folder) {
    SimulatedRobot robot(map, start, options);
    Drive drive;
    try {
        Navigator navigator(robot, config, cache_folder);
        drive.path = turn(robot, first_heading_rad, options);
        navigator.navigateWaypoints(toSequence(waypoints, options));
        follow(robot, navigator, options, drive);
    } catch (const std::exception& e) {
        throw Error("MRPT refuses the settings of the drive: " + messageOf(e.what()),
                    "compare them with ini/drive.ini");
    }
    if (robot.touched()) sayWarning("the navigator saw points of the map within the robot's body");
    return drive;
}

}  // namespace rgbd_graphslam
