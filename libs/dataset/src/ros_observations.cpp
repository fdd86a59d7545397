#include "ros_observations.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>

#include <cmath>

#include "rgbd_graphslam/dataset/gps_accuracy.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

/** About z; by nothing where the driver gave no number. */
SE3 turnedLeft(double angle_rad) {
    if (!std::isfinite(angle_rad)) return SE3();
    return {Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
            Eigen::Vector3d::Zero()};
}

/** NMEA's quality of sensor_msgs/NavSatStatus. */
std::uint8_t fixQuality(int status) {
    switch (status) {
        case -1:
            return 0;  // none
        case 1:
            return 2;  // satellite-based augmentation: differential
        case 2:
            return 3;  // ground-based
        default:
            return 1;
    }
}

}  // namespace

mrpt::obs::CObservation::Ptr toObservation(const ros::LaserScan& scan, const std::string& label,
                                           const SE3& T_base_laser) {
    auto observation = mrpt::obs::CObservation2DRangeScan::Create();
    observation->sensorLabel = label;
    observation->timestamp = toMrptTime(scan.header.stamp_s);
    const std::size_t gaps = scan.ranges.empty() ? 0 : scan.ranges.size() - 1;
    const double span = static_cast<double>(gaps) * scan.angle_increment;
    observation->aperture = static_cast<float>(std::abs(span));
    observation->rightToLeft = span >= 0;
    observation->maxRange = scan.range_max;
    observation->sensorPose = toCPose3D(T_base_laser * turnedLeft(scan.angle_min + span / 2));
    observation->resizeScan(scan.ranges.size());
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
        const float range = scan.ranges[i];
        const bool valid =
            std::isfinite(range) && range >= scan.range_min && range <= scan.range_max;
        observation->setScanRange(i, valid ? range : 0.0F);
        observation->setScanRangeValidity(i, valid);
    }
    return observation;
}

mrpt::obs::CObservation::Ptr toObservation(const ros::NavSatFix& fix, const std::string& label,
                                           const SE3& T_base_antenna) {
    mrpt::obs::gnss::Message_NMEA_GGA gga;
    gga.fields.latitude_degrees = fix.latitude_deg;
    gga.fields.longitude_degrees = fix.longitude_deg;
    gga.fields.altitude_meters = fix.altitude_m;
    gga.fields.fix_quality = fixQuality(fix.status);
    const double horizontal_m2 = fix.covariance_m2.topLeftCorner<2, 2>().trace();
    if (horizontal_m2 > 0) {
        gga.fields.thereis_HDOP = true;
        gga.fields.HDOP = static_cast<float>(std::sqrt(horizontal_m2) / gps_range_error_m);
    }
    auto observation = mrpt::obs::CObservationGPS::Create();
    observation->sensorLabel = label;
    observation->timestamp = toMrptTime(fix.header.stamp_s);
    observation->sensorPose = toCPose3D(T_base_antenna);
    observation->setMsg(gga);
    return observation;
}

}  // namespace rgbd_graphslam
