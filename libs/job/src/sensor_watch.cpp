#include "sensor_watch.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/accelerometer_check.h"
#include "rgbd_graphslam/dataset/gyroscope_check.h"
#include "rgbd_graphslam/dataset/inertial_reading.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t first_comparison = 60;
constexpr double longest_gap_s = 0.5;
/** A sensor that ends earlier is told of. */
constexpr double least_end_s = 5, least_end_share = 0.2;

/** Only poses from landmarks: others may follow the very sensor that is compared with them. */
TrackedStretches trackedStretches(const VisualSlam& slam) {
    TrackedStretches stretches;
    const TrackedFrame* last = nullptr;
    const auto frames = slam.frames();
    for (const TrackedFrame& frame : frames) {
        const bool tracked = frame.origin == FrameOrigin::Tracked;
        const bool goes_on = tracked && last && last->submap == frame.submap &&
                             frame.stamp_s - last->stamp_s <= longest_gap_s;
        if (tracked && !goes_on) stretches.emplace_back();
        if (tracked) stretches.back().push_back({frame.stamp_s, frame.T_world_cam});
        last = tracked ? &frame : nullptr;
    }
    return stretches;
}

}  // namespace

SensorWatch::SensorWatch(const mrpt::obs::CObservation3DRangeScan& first_frame)
    : T_base_camera_sensor_(toSE3(first_frame.sensorPose)),
      T_base_cam_(cameraOnRobot(first_frame)),
      depth_units_(1 / first_frame.rangeUnits) {}

bool SensorWatch::watched(Sensor& sensor, const mrpt::obs::CObservation& observation) {
    if (!sensor.label) sensor.label = observation.sensorLabel;
    return sensor.label == observation.sensorLabel;
}

void SensorWatch::note(const mrpt::obs::CObservation& observation) {
    using namespace mrpt::obs;
    const double stamp_s = toSeconds(observation.timestamp);
    if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
        const mrpt::poses::CPose2D& pose = odometry->odometry;
        const Eigen::Vector3d reading(pose.x(), pose.y(), pose.phi());
        if (!reading.allFinite() || !watched(odometry_, observation)) return;
        odometry_.readings.add({stamp_s, reading});
    } else if (const auto* imu = dynamic_cast<const CObservationIMU*>(&observation)) {
        const auto keep = [&](const auto& reading, Sensor& sensor) {
            if (!reading || !watched(sensor, observation)) return;
            sensor.T_base_sensor = toSE3(imu->sensorPose);
            sensor.readings.add({stamp_s, *reading});
        };
        keep(angularVelocity(*imu), gyroscope_);
        keep(specificForce(*imu), accelerometer_);
    }
}

void SensorWatch::withhold(Frame& frame) const {
    if (odometry_.left_out) {
        frame.reckoning.T_odometry_cam.reset();
        frame.readings.wheels.clear();
    }
    if (gyroscope_.left_out) {
        frame.reckoning.R_gyroscope_cam.reset();
        frame.readings.imu.clear();
    }
}

void SensorWatch::compareWhenDue(const VisualSlam& slam, std::size_t frames) {
    std::size_t due = first_comparison;
    while (due < frames) due += due / 2;
    if (frames == due) compare(slam);
}

void SensorWatch::conclude(const VisualSlam& slam) {
    const auto frames = slam.frames();
    bridged_frames_ = std::count_if(frames.begin(), frames.end(), [](const TrackedFrame& frame) {
        return frame.origin == FrameOrigin::DeadReckoned;
    });
    compare(slam);
    compareScale(trackedStretches(slam));
    tellOfEnds(slam);
}

void SensorWatch::tellOfEnds(const VisualSlam& slam) const {
    const auto frames = slam.frames();
    if (frames.empty()) return;
    const double first_s = frames.front().stamp_s, last_s = frames.back().stamp_s;
    const std::pair<const char*, const Sensor*> sensors[] = {
        {"gyroscope", &gyroscope_}, {"accelerometer", &accelerometer_}, {"odometry", &odometry_}};
    for (const auto& [kind, sensor] : sensors) {
        if (!sensor->label) continue;
        const std::string name = std::string(kind) + " '" + *sensor->label + "'";
        const auto& readings = sensor->readings;
        const double missing_s = last_s - readings.lastStamp();
        if (readings.lastStamp() < first_s || readings.firstStamp() > last_s) {
            sayWarning(name + " has no reading from the time of the frames: is its clock another?");
        } else if (missing_s > std::max(least_end_s, least_end_share * (last_s - first_s))) {
            char text[80];
            std::snprintf(text, sizeof text,
                          " ends %.1f s before the last frame, of %.1f s of frames", missing_s,
                          last_s - first_s);
            sayWarning(name + text);
        }
    }
}

void SensorWatch::compare(const VisualSlam& slam) {
    if (!gyroscope_.label && !odometry_.label) return;
    const TrackedStretches camera = trackedStretches(slam);
    if (gyroscope_.label) compareGyroscope(camera);
    if (odometry_.label) compareOdometry(camera);
}

void SensorWatch::compareGyroscope(const TrackedStretches& camera) {
    const SE3 T_cam_gyroscope = T_base_cam_.inverse() * gyroscope_.T_base_sensor;
    const SensorVerdict verdict =
        checkGyroscope(gyroscope_.readings.kept(), movedAlong(camera, T_cam_gyroscope));
    if (verdict.measured_delay) gyroscope_delay_ = verdict.measured_delay;
    const ImuMount mount{T_base_camera_sensor_, gyroscope_.T_base_sensor};
    take(verdict, "gyroscope", imuRemedy(verdict, mount, true), gyroscope_);
}

void SensorWatch::compareOdometry(const TrackedStretches& camera) {
    const OdometryVerdict verdict = checkOdometry(
        odometry_.readings.kept(), movedAlong(camera, T_base_cam_.inverse()), depth_units_);
    take(verdict, "odometry", odometryRemedy(verdict), odometry_);
}

void SensorWatch::take(const SensorVerdict& verdict, const std::string& kind,
                       const std::string& remedy, Sensor& sensor) const {
    if (verdict.fault != SensorFault::Undecided) sensor.left_out = verdict.wrong();
    if (!verdict.wrong() || sensor.told) return;
    sensor.told = true;
    std::string text = wrongSensorText(kind, *sensor.label, verdict, remedy);
    if (bridged_frames_ > 0) {
        text += "; found only at the end: " + std::to_string(bridged_frames_) +
                " weakly tracked frames may have followed it";
    }
    sayWarning(text);
}

/** The accelerometer knows what a meter is; so do depth readings, when their unit is right. */
void SensorWatch::compareScale(const TrackedStretches& camera) const {
    constexpr double largest_honest_scale = 1.6;
    if (!accelerometer_.label || odometry_.left_out) return;
    const auto path = movedAlong(camera, T_base_cam_.inverse() * accelerometer_.T_base_sensor);
    const auto& readings = accelerometer_.readings.kept();
    if (checkAccelerometer(readings, path).wrong()) return;
    const auto scale = scaleByAccelerometer(readings, path);
    if (!scale || (*scale<largest_honest_scale&& * scale> 1 / largest_honest_scale)) return;
    char text[240];
    std::snprintf(text, sizeof text,
                  "accelerometer '%s' feels %.2g times the acceleration that the camera shows: "
                  "depth_units should be about %.2g instead of %g",
                  accelerometer_.label->c_str(), *scale, depth_units_ / *scale, depth_units_);
    sayWarning(text);
}

void SensorWatch::save(ByteWriter& out) const {
    for (const Sensor* sensor : {&gyroscope_, &odometry_}) {
        putFlag(sensor->left_out, out);
        putFlag(sensor->told, out);
    }
}

void SensorWatch::load(ByteReader& in) {
    for (Sensor* sensor : {&gyroscope_, &odometry_}) {
        sensor->left_out = getFlag(in);
        sensor->told = getFlag(in);
    }
}

}  // namespace rgbd_graphslam
