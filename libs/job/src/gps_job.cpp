#include "gps_job.h"

#include <cmath>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/gps_accuracy.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

constexpr double usual_sigma_m = 2, vertical_share = 2;

/** What the receiver tells, else a usual one. */
Eigen::Vector3d sigmaOf(const mrpt::obs::gnss::Message_NMEA_GGA::content_t& gga,
                        const GpsOptions& options) {
    double sigma_m = usual_sigma_m;
    if (gga.thereis_HDOP && gga.HDOP > 0 && gga.HDOP < 50) {
        sigma_m = gps_range_error_m * gga.HDOP / std::sqrt(2.0);
    }
    if (options.sigma_m > 0) sigma_m = options.sigma_m;
    return {sigma_m, sigma_m, vertical_share * sigma_m};
}

/** Nothing where the receiver had none. */
std::optional<GpsFix> fixOf(const mrpt::obs::CObservationGPS& gps, const GpsOptions& options) {
    if (!gps.hasMsgClass<mrpt::obs::gnss::Message_NMEA_GGA>()) return std::nullopt;
    const auto& gga = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
    GpsFix fix;
    fix.stamp_s = toSeconds(gps.timestamp);
    fix.place = {gga.latitude_degrees, gga.longitude_degrees,
                 gga.altitude_meters + gga.geoidal_distance};
    fix.sigma_m = sigmaOf(gga, options);
    const bool is_place = std::isfinite(fix.place.latitude_deg + fix.place.longitude_deg) &&
                          std::abs(fix.place.latitude_deg) <= 90;
    if (gga.fix_quality == 0 || !is_place) return std::nullopt;
    if (!std::isfinite(fix.place.altitude_m)) fix.place.altitude_m = 0;
    return fix;
}

template <class Sample>
std::vector<double> stampsOf(const std::vector<Sample>& samples) {
    std::vector<double> stamps_s;
    for (const Sample& sample : samples) stamps_s.push_back(sample.stamp_s);
    return stamps_s;
}

std::string labelOf(const SensorLog& log, const char* class_name) {
    for (const SensorRecord& sensor : log.sensors) {
        if (sensor.used && sensor.class_name == class_name) return sensor.label;
    }
    return {};
}

std::string gpsText(const GpsFusionResult& result) {
    const FixResiduals &used = result.used, &held_out = result.held_out;
    std::string text = formatted(
        "position; horizontal residual %.2f m (RMS), the receiver claims %.2f m, %zu beyond 3 "
        "sigmas",
        used.horizontal_rms_m, used.claimed_rms_m, used.outliers);
    if (held_out.fixes > 0) {
        text += formatted("; %zu fixes held out: %.2f m, the receiver claims %.2f m",
                          held_out.fixes, held_out.horizontal_rms_m, held_out.claimed_rms_m);
    }
    return text;
}

void describeSensors(const SensorLog& log, const GpsLog& gps, const GpsFusionResult& result,
                     CameralessRun& run) {
    auto& all = run.report.sensor_figures;
    all.push_back(figuresOf(gps.label, "CObservationGPS", stampsOf(gps.fixes)));
    all.back().used = result.used.fixes;
    all.back().residual_m = result.used.horizontal_rms_m;
    all.back().whitened = result.used.whitened_rms;
    all.back().use = gpsText(result);
    all.push_back(figuresOf(labelOf(log, "CObservationOdometry"), "CObservationOdometry",
                            stampsOf(log.wheels)));
    all.back().used = log.wheels.size();
    all.back().use = formatted(
        "motion between the fixes, ways multiplied by %.3f; error after 1 m taken as %.2f m",
        result.wheel_scale, result.wheel_slip_share);
    if (log.imu.empty()) return;
    all.push_back(figuresOf(labelOf(log, "CObservationIMU"), "CObservationIMU", stampsOf(log.imu)));
    const bool refused = !result.gyroscope_refused.empty();
    all.back().used = refused ? 0 : log.imu.size();
    all.back().use = refused ? "not used: " + result.gyroscope_refused
                             : formatted(
                                   "turns between the fixes; bias of the rate about z %.5f "
                                   "rad/s",
                                   result.gyro_bias_rad_s);
}

void collect(const GpsFusionResult& result, CameralessRun& run) {
    run.trajectory = result.trajectory;
    run.keyframes = result.keyframes;
    run.edges = result.edges;
    run.georeference = GeoReference{result.plane.origin(), 0};
    for (const StampedPose& pose : run.trajectory) {
        TrackedFrame frame;
        frame.stamp_s = pose.stamp_s;
        frame.origin = FrameOrigin::Tracked;
        frame.T_world_cam = pose.T_world_cam;
        run.frames.push_back(frame);
    }
}

}  // namespace

GpsLog gpsLog(const SensorLog& log, const GpsOptions& options) {
    GpsLog gps;
    for (const auto& observation : log.fixes) {
        const auto fix = fixOf(*observation, options);
        gps.without_fix += !fix;
        if (fix) gps.fixes.push_back(*fix);
    }
    if (log.fixes.empty()) return gps;
    gps.label = log.fixes.front()->sensorLabel;
    gps.lever_arm = toSE3(log.fixes.front()->sensorPose).t;
    return gps;
}

void fuseWithGps(const SensorLog& log, CameralessRun& run) {
    const GpsLog gps = gpsLog(log, run.job.options.gps);
    if (gps.without_fix > 0) {
        sayWarning(std::to_string(gps.without_fix) + " of " + std::to_string(log.fixes.size()) +
                   " GPS messages have no fix and are left out");
    }
    const GpsFusionResult result =
        fuseGps({log.wheels, log.imu, gps.fixes, gps.lever_arm}, run.job.options.gps);
    if (!result.gyroscope_refused.empty()) {
        sayWarning("the gyroscope is left out: " + result.gyroscope_refused);
    }
    collect(result, run);
    describeSensors(log, gps, result, run);
}

}  // namespace rgbd_graphslam
