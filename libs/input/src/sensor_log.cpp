#include "rgbd_graphslam/input/sensor_log.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/inertial_reading.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {
namespace {

using mrpt::obs::CObservation;

bool isCamera(const CObservation& observation) {
    return dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation) ||
           dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
}

/** Takes readings of the first sensor of a kind, as long as their stamps rise. */
class Turn {
  public:
    explicit Turn(std::string label = {}) : label_(std::move(label)) {}

    enum class Verdict { Taken, OtherSensor, OutOfOrder };
    Verdict of(const CObservation& observation) {
        if (label_.empty()) label_ = observation.sensorLabel;
        if (observation.sensorLabel != label_) return Verdict::OtherSensor;
        const double stamp_s = toSeconds(observation.timestamp);
        if (last_s_ && stamp_s <= *last_s_) return Verdict::OutOfOrder;
        last_s_ = stamp_s;
        return Verdict::Taken;
    }

  private:
    std::string label_;
    std::optional<double> last_s_;
};

class LogReader {
  public:
    LogReader(const std::string& rawlog, const std::string& laser_label)
        : reader_(rawlog), scans_(laser_label) {}

    SensorLog read() {
        try {
            while (const auto observation = reader_.next()) {
                census_.note(*observation, take(observation));
            }
        } catch (const Error& e) {
            log_.damage = e.what();
        }
        log_.sensors = census_.sensors();
        return std::move(log_);
    }

  private:
    bool take(const CObservation::Ptr& observation) {
        using namespace mrpt::obs;
        if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) {
            return takes(scans_.of(*scan), log_.scans_out_of_order, log_.scans, scan);
        }
        if (const auto fix = std::dynamic_pointer_cast<CObservationGPS>(observation)) {
            return takes(fixes_.of(*fix), log_.others_out_of_order, log_.fixes, fix);
        }
        if (const auto* wheels = dynamic_cast<const CObservationOdometry*>(observation.get())) {
            return takeWheels(*wheels);
        }
        if (const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get())) {
            return takeImu(*imu);
        }
        if (const auto* truth = dynamic_cast<const CObservationRobotPose*>(observation.get())) {
            log_.truth.push_back({toSeconds(truth->timestamp), toSE3(truth->pose.mean)});
        }
        return false;
    }

    template <class Values, class Value>
    static bool takes(Turn::Verdict verdict, std::size_t& out_of_order, Values& values,
                      const Value& value) {
        out_of_order += verdict == Turn::Verdict::OutOfOrder;
        if (verdict == Turn::Verdict::Taken) values.push_back(value);
        return verdict == Turn::Verdict::Taken;
    }

    bool takeWheels(const mrpt::obs::CObservationOdometry& odometry) {
        const auto& pose = odometry.odometry;
        if (!std::isfinite(pose.x() + pose.y() + pose.phi())) return false;
        return takes(wheels_.of(odometry), log_.others_out_of_order, log_.wheels,
                     WheelSample{toSeconds(odometry.timestamp), {pose.x(), pose.y(), pose.phi()}});
    }

    bool takeImu(const mrpt::obs::CObservationIMU& imu) {
        const auto rate = angularVelocity(imu);
        if (!rate) return false;
        const Eigen::Matrix3d R_base_imu = toSE3(imu.sensorPose).R;
        const Eigen::Vector3d force = specificForce(imu).value_or(Eigen::Vector3d::Zero());
        return takes(imu_.of(imu), log_.others_out_of_order, log_.imu,
                     ImuSample{toSeconds(imu.timestamp), R_base_imu * *rate, R_base_imu * force});
    }

    RawlogReader reader_;
    SensorCensus census_;
    SensorLog log_;
    Turn scans_, fixes_, wheels_, imu_;
};

PlanarPose between(const WheelSample& a, const WheelSample& b, double stamp_s) {
    const double share = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
    const PlanarPose &from = a.T_start_base, &to = b.T_start_base;
    return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
            from.yaw + share * std::remainder(to.yaw - from.yaw, 2 * M_PI)};
}

}  // namespace

CameralessKind cameralessKind(const std::string& rawlog) {
    RawlogReader reader(rawlog);
    bool scans = false, fixes = false;
    try {
        while (const auto observation = reader.next()) {
            if (isCamera(*observation)) return CameralessKind::None;
            scans |= !!std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
            fixes |= !!std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(observation);
        }
    } catch (const Error&) {  // told by whoever reads it for its contents
    }
    if (scans) return CameralessKind::Laser;
    return fixes ? CameralessKind::Gps : CameralessKind::None;
}

SensorLog readSensorLog(const std::string& rawlog, const std::string& laser_label) {
    SensorLog log = LogReader(rawlog, laser_label).read();
    if (!laser_label.empty() && log.scans.empty()) {
        throw Error("the rawlog '" + rawlog + "' has no laser '" + laser_label + "'; it has " +
                        sensorsText(log.sensors, false),
                    "give --sensor the label of a laser, or leave it out");
    }
    return log;
}

std::optional<PlanarPose> wheelPoseAt(const std::vector<WheelSample>& wheels, double stamp_s,
                                      double longest_reach_s) {
    const auto after = std::lower_bound(
        wheels.begin(), wheels.end(), stamp_s,
        [](const WheelSample& sample, double stamp) { return sample.stamp_s < stamp; });
    const bool has_after = after != wheels.end(), has_before = after != wheels.begin();
    if (has_after && after->stamp_s == stamp_s) return after->T_start_base;
    if (has_after && has_before && after->stamp_s - (after - 1)->stamp_s <= 2 * longest_reach_s) {
        return between(*(after - 1), *after, stamp_s);
    }
    if (has_before && stamp_s - (after - 1)->stamp_s <= longest_reach_s) {
        return (after - 1)->T_start_base;
    }
    if (has_after && after->stamp_s - stamp_s <= longest_reach_s) return after->T_start_base;
    return std::nullopt;
}

}  // namespace rgbd_graphslam
