#include "sensor_entries.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <array>
#include <map>

#include "number_text.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {

void addTruth(const RgbdSequence& sequence, const CameraSetup& setup, SensorEntries& entries) {
    const SE3 T_cam_base = T_optical_from_mrpt * setup.T_base_sensor.inverse();
    for (const auto& [stamp_s, T_world_cam] : sequence.truth) {
        auto pose = mrpt::obs::CObservationRobotPose::Create();
        pose->sensorLabel = ground_truth_label;
        pose->timestamp = toMrptTime(stamp_s);
        pose->pose.mean = toCPose3D(T_world_cam * T_cam_base);
        entries.push_back(pose);
    }
}

using ImuAxes = std::array<mrpt::obs::TIMUDataIndex, 3>;

void set(mrpt::obs::CObservationIMU& imu, const ImuAxes& axes, const Eigen::Vector3d& value) {
    for (int i = 0; i < 3; ++i) imu.set(axes[i], value[i]);
}

mrpt::obs::CObservationIMU::Ptr imuReading(const CameraSetup& setup, double stamp_s) {
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->sensorLabel = imu_label;
    imu->timestamp = toMrptTime(stamp_s);
    imu->sensorPose = toCPose3D(setup.T_base_sensor * setup.T_sensor_imu);
    return imu;
}

/** Readings of accelerometer and gyroscope at the same stamp share an observation. */
void addImu(const RgbdSequence& sequence, const CameraSetup& setup, SensorEntries& entries) {
    using namespace mrpt::obs;
    const ImuAxes linear = {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC}, angular = {IMU_WX, IMU_WY, IMU_WZ};
    std::map<long long, CObservationIMU::Ptr> without_angular;
    for (const auto& sample : sequence.acceleration) {
        const auto imu = imuReading(setup, sample.stamp_s);
        set(*imu, linear, sample.value);
        without_angular[microseconds(sample.stamp_s)] = imu;
        entries.push_back(imu);
    }
    for (const auto& sample : sequence.angular_velocity) {
        auto partner = without_angular.extract(microseconds(sample.stamp_s));
        const auto imu = partner ? partner.mapped() : imuReading(setup, sample.stamp_s);
        set(*imu, angular, sample.value);
        if (!partner) entries.push_back(imu);
    }
}

void addOdometry(const RgbdSequence& sequence, SensorEntries& entries) {
    for (const auto& sample : sequence.odometry) {
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = odometry_label;
        odometry->timestamp = toMrptTime(sample.stamp_s);
        odometry->odometry = {sample.value.x(), sample.value.y(), sample.value.z()};
        entries.push_back(odometry);
    }
}

}  // namespace

SensorEntries sensorEntries(const RgbdSequence& sequence, const CameraSetup& setup,
                            ImportReport& report) {
    SensorEntries entries;
    addTruth(sequence, setup, entries);
    report.truth = entries.size();
    addImu(sequence, setup, entries);
    report.imu = entries.size() - report.truth;
    addOdometry(sequence, entries);
    report.odometry = entries.size() - report.truth - report.imu;
    entries.insert(entries.end(), sequence.others.begin(), sequence.others.end());
    report.others = sequence.others.size();
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    return entries;
}

}  // namespace rgbd_graphslam
