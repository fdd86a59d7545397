#include "../../../libs/input/src/motion_readings_collector.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {
using namespace mrpt::obs;

CObservationIMU imuAt(double stamp_s, const std::string& label = "IMU") {
    CObservationIMU imu;
    imu.sensorLabel = label;
    imu.timestamp = toMrptTime(stamp_s);
    return imu;
}

CObservationIMU withRate(CObservationIMU imu, double x) {
    imu.set(IMU_WX, x);
    imu.set(IMU_WY, 0);
    imu.set(IMU_WZ, 0);
    return imu;
}

CObservationIMU withForce(CObservationIMU imu, double z) {
    imu.set(IMU_X_ACC, 0);
    imu.set(IMU_Y_ACC, 0);
    imu.set(IMU_Z_ACC, z);
    return imu;
}

TEST(MotionReadingsCollector, HandsOutWhatCameSinceTheLastTime) {
    MotionReadingsCollector collector;
    collector.note(withForce(withRate(imuAt(1), 0.1), 9.8));
    collector.note(withForce(withRate(imuAt(2), 0.2), 9.9));
    const MotionReadings first = collector.take({});
    ASSERT_EQ(first.imu.size(), 2u);
    EXPECT_EQ(first.imu[1].gyro.x(), 0.2);
    EXPECT_EQ(first.imu[1].accelerometer.z(), 9.9);
    EXPECT_TRUE(collector.take({}).imu.empty());
}

TEST(MotionReadingsCollector, InterpolatesAnAccelerometerOfItsOwnRate) {
    MotionReadingsCollector collector;
    collector.note(withForce(imuAt(1, "ACC"), 9));
    collector.note(withRate(imuAt(1.5, "GYRO"), 0.1));
    EXPECT_TRUE(collector.take({}).imu.empty()) << "it waits for the next force";
    collector.note(withForce(imuAt(2, "ACC"), 10));
    collector.note(withRate(imuAt(2.25, "GYRO"), 0.2));
    collector.note(withForce(imuAt(3, "ACC"), 12));
    const auto imu = collector.take({}).imu;
    ASSERT_EQ(imu.size(), 2u);
    EXPECT_NEAR(imu[0].accelerometer.z(), 9.5, 1e-5);
    EXPECT_NEAR(imu[1].accelerometer.z(), 10.5, 1e-5);
    EXPECT_EQ(imu[1].gyro.x(), 0.2);
}

TEST(MotionReadingsCollector, PassesOverWhatRepeatsGoesBackOrIsAnother) {
    MotionReadingsCollector collector;
    for (const double stamp_s : {1.0, 2.0, 2.0, 1.5, 3.0}) {
        collector.note(withForce(withRate(imuAt(stamp_s), stamp_s), 9.8));
        collector.note(withForce(withRate(imuAt(stamp_s + 0.1, "OTHER"), 7), 9.8));
    }
    const auto imu = collector.take({}).imu;
    ASSERT_EQ(imu.size(), 3u);
    EXPECT_EQ(imu[2].gyro.x(), 3);
}

TEST(MotionReadingsCollector, TakesWheelsAndKnowsWhereTheCameraIs) {
    MotionReadingsCollector collector;
    CObservationOdometry odometry;
    odometry.odometry = mrpt::poses::CPose2D(1, 2, 0.5);
    odometry.timestamp = toMrptTime(4);
    collector.note(odometry);
    const SE3 T_base_cam(rotationExp({0, 0, 1}), {0.1, 0, 0.6});
    const MotionReadings readings = collector.take(T_base_cam);
    ASSERT_EQ(readings.wheels.size(), 1u);
    EXPECT_EQ(readings.wheels[0].T_start_base.yaw, 0.5);
    EXPECT_EQ(readings.T_base_cam.t, T_base_cam.t);
}

}  // namespace
}  // namespace rgbd_graphslam
