/** IMU and odometry against tracked motion, in worlds made of numbers. */
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "rgbd_graphslam/dataset/accelerometer_check.h"
#include "rgbd_graphslam/dataset/gyroscope_check.h"
#include "rgbd_graphslam/dataset/odometry_check.h"
#include "rgbd_graphslam/dataset/sensor_remedy.h"
#include "rgbd_graphslam/dataset/signed_axes.h"

namespace rgbd_graphslam {
namespace {

using Readings = std::vector<StampedVector>;
using Motion = std::function<SE3(double)>;

constexpr double seconds = 14, frame_s = 1.0 / 30, reading_s = 0.005, degree = M_PI / 180;

/** Noise with a spread of one, the same in each run. */
class Noise {
  public:
    double operator()() { return (random_() / 4294967295.0 - 0.5) * std::sqrt(12.0); }
    Eigen::Vector3d vector(double spread) {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return spread * Eigen::Vector3d(x, y, z);
    }

  private:
    std::mt19937 random_{1};
};

/** A hand that looks around and walks a little. */
SE3 handHeld(double t) {
    const Eigen::Vector3d turned(0.4 * std::sin(0.9 * t), 0.5 * std::sin(0.7 * t + 1),
                                 0.3 * std::sin(1.3 * t + 2));
    const Eigen::Vector3d position(0.3 * std::sin(1.1 * t), 0.2 * std::sin(1.9 * t + 1),
                                   0.1 * std::sin(2.7 * t));
    return {rotationExp(turned), position};
}

/** Base of a robot, on a winding way. */
SE3 driving(double t) {
    const double heading = 0.8 * std::sin(0.5 * t);
    const Eigen::Vector3d position(0.4 * t, 0.3 * std::sin(0.5 * t), 0);
    return {rotationExp({0, 0, heading}), position};
}

SE3 standing(double /*t*/) {
    return {};
}

TrackedStretches track(const Motion& motion, double position_noise_m = 0.001,
                       double rotation_noise_rad = 0.0008) {
    Noise noise;
    Trajectory trajectory;
    for (double t = 0; t < seconds; t += frame_s) {
        SE3 pose = motion(t);
        pose.t += noise.vector(position_noise_m);
        pose.R = pose.R * rotationExp(noise.vector(rotation_noise_rad));
        trajectory.push_back({t, pose});
    }
    return {trajectory};
}

Readings gyroscope(const Motion& motion) {
    constexpr double step_s = 1e-4;
    Noise noise;
    Readings readings;
    for (double t = -1; t < seconds + 1; t += reading_s) {
        const Eigen::Matrix3d R = motion(t - step_s).R.transpose() * motion(t + step_s).R;
        const Eigen::Vector3d bias(0.01, -0.02, 0.015);
        readings.push_back({t, rotationLog(R) / (2 * step_s) + bias + noise.vector(0.005)});
    }
    return readings;
}

Readings accelerometer(const Motion& motion) {
    constexpr double step_s = 1e-3;
    Noise noise;
    Readings readings;
    for (double t = -1; t < seconds + 1; t += reading_s) {
        const Eigen::Vector3d acceleration =
            (motion(t + step_s).t - 2 * motion(t).t + motion(t - step_s).t) / (step_s * step_s);
        const Eigen::Vector3d force = acceleration + Eigen::Vector3d(0, 0, 9.81);
        const Eigen::Vector3d bias(0.05, -0.08, 0.06);
        readings.push_back({t, motion(t).R.transpose() * force + bias + noise.vector(0.05)});
    }
    return readings;
}

Readings odometry(const Motion& motion) {
    Readings readings;
    for (double t = -1; t < seconds + 1; t += 0.05) {
        const SE3 pose = motion(t);
        readings.push_back({t, {1.01 * pose.t.x(), 1.01 * pose.t.y(), rotationLog(pose.R).z()}});
    }
    return readings;
}

Readings changed(Readings readings, const std::function<Eigen::Vector3d(Eigen::Vector3d)>& change,
                 double delay_s = 0) {
    for (StampedVector& reading : readings) {
        reading.value = change(reading.value);
        reading.stamp_s += delay_s;
    }
    return readings;
}

Readings times(double factor, const Readings& readings) {
    return changed(readings, [&](const auto& v) { return Eigen::Vector3d(factor * v); });
}

Readings turned(const Eigen::Matrix3d& axes, const Readings& readings) {
    return changed(readings, [&](const auto& v) { return Eigen::Vector3d(axes * v); });
}

TEST(SignedAxes, thereAre48AndTheIdentityIsTheSimplest) {
    const auto& all = signedAxes();
    ASSERT_EQ(all.size(), 48u);
    EXPECT_TRUE(all[0].isIdentity());
    EXPECT_TRUE((-all[1]).isIdentity());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE((all[i] * all[i].transpose()).isIdentity());
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT((all[i] - all[j]).norm(), 1) << i << " " << j;
    }
}

TEST(GyroscopeCheck, agreesWithTheCameraItIsOn) {
    const SensorVerdict verdict = checkGyroscope(gyroscope(handHeld), track(handHeld));
    EXPECT_EQ(verdict.fault, SensorFault::None) << verdict.finding;
    EXPECT_EQ(verdict.finding, "");
}

TEST(GyroscopeCheck, unitIsNamed) {
    const auto verdict = checkGyroscope(times(1 / degree, gyroscope(handHeld)), track(handHeld));
    EXPECT_EQ(verdict.fault, SensorFault::Unit);
    EXPECT_NEAR(verdict.factor, 57.3, 1.5);
    EXPECT_NE(verdict.finding.find("deg/s"), std::string::npos) << verdict.finding;
    EXPECT_EQ(imuRemedy(verdict, {}, true), "import with --imu-gyro-unit deg/s");
}

TEST(GyroscopeCheck, anyAxesAreFound) {
    const Readings right = gyroscope(handHeld);
    const TrackedStretches camera = track(handHeld);
    for (const Eigen::Matrix3d& axes : signedAxes()) {
        const SensorVerdict verdict = checkGyroscope(turned(axes, right), camera);
        EXPECT_TRUE(verdict.axes.isApprox(axes.transpose())) << axes << "\n" << verdict.axes;
        EXPECT_EQ(verdict.wrong(), !axes.isIdentity());
    }
}

TEST(GyroscopeCheck, delayIsMeasured) {
    const Readings right = gyroscope(handHeld);
    const TrackedStretches camera = track(handHeld);
    for (const double delay_s : {-0.4, -0.1, 0.08, 0.1, 0.4}) {
        const Readings late = changed(
            right, [](const auto& v) { return v; }, delay_s);
        const SensorVerdict verdict = checkGyroscope(late, camera);
        EXPECT_EQ(verdict.fault, SensorFault::TimeOffset) << delay_s;
        EXPECT_NEAR(verdict.delay_s, delay_s, 0.005);
    }
}

TEST(GyroscopeCheck, noiseInsteadOfReadingsIsUnusable) {
    Noise noise;
    const Readings readings =
        changed(gyroscope(handHeld), [&](const auto&) { return noise.vector(1); });
    EXPECT_EQ(checkGyroscope(readings, track(handHeld)).fault, SensorFault::Unusable);
}

TEST(GyroscopeCheck, nothingIsSaidOfACameraThatStands) {
    const Readings wrong = times(1 / degree, gyroscope(standing));
    EXPECT_EQ(checkGyroscope(wrong, track(standing)).fault, SensorFault::Undecided);
    EXPECT_EQ(checkGyroscope({}, track(handHeld)).fault, SensorFault::Undecided);
    EXPECT_EQ(checkGyroscope(wrong, {}).fault, SensorFault::Undecided);
}

TEST(AccelerometerCheck, agreesWithTheCameraItIsOn) {
    const SensorVerdict verdict = checkAccelerometer(accelerometer(handHeld), track(handHeld));
    EXPECT_EQ(verdict.fault, SensorFault::None) << verdict.finding;
}

TEST(AccelerometerCheck, unitIsNamed) {
    const Readings right = accelerometer(handHeld);
    const TrackedStretches camera = track(handHeld);
    const std::vector<std::pair<std::string, double>> units = {
        {"g", 1 / 9.81}, {"mg", 1000 / 9.81}, {"mm/s2", 1000}};
    for (const auto& [unit, factor] : units) {
        const SensorVerdict verdict = checkAccelerometer(times(factor, right), camera);
        EXPECT_EQ(verdict.fault, SensorFault::Unit) << unit;
        EXPECT_EQ(imuRemedy(verdict, {}, false), "import with --imu-accel-unit " + unit);
    }
    const SensorVerdict without_gravity = checkAccelerometer(times(0.03, right), camera);
    EXPECT_EQ(without_gravity.fault, SensorFault::Unusable);
}

TEST(AccelerometerCheck, anyAxesAreFound) {
    const Readings right = accelerometer(handHeld);
    const TrackedStretches camera = track(handHeld);
    for (const Eigen::Matrix3d& axes : signedAxes()) {
        const SensorVerdict verdict = checkAccelerometer(turned(axes, right), camera);
        EXPECT_TRUE(verdict.axes.isApprox(axes.transpose())) << axes << "\n" << verdict.axes;
        EXPECT_EQ(verdict.wrong(), !axes.isIdentity());
    }
}

TEST(AccelerometerCheck, negatedInGBothAreNamed) {
    const auto verdict =
        checkAccelerometer(times(-1 / 9.81, accelerometer(handHeld)), track(handHeld));
    EXPECT_EQ(verdict.fault, SensorFault::Sign);
    EXPECT_NE(verdict.finding.find("in g"), std::string::npos) << verdict.finding;
    EXPECT_NE(verdict.finding.find("negated"), std::string::npos) << verdict.finding;
    EXPECT_EQ(imuRemedy(verdict, {}, false), "import with --imu-accel-unit=-9.81");
}

TEST(AccelerometerCheck, ofACameraThatStandsTheSignIsOpen) {
    const Readings right = accelerometer(standing);
    EXPECT_EQ(checkAccelerometer(right, track(standing)).fault, SensorFault::Undecided);
    EXPECT_EQ(checkAccelerometer(times(-1, right), track(standing)).fault, SensorFault::Undecided);
    EXPECT_EQ(checkAccelerometer({}, track(standing)).fault, SensorFault::Undecided);
}

TEST(AccelerometerCheck, knowsTheScaleOfTheWay) {
    TrackedStretches small = track(handHeld, 0.0003);
    const auto right = scaleByAccelerometer(accelerometer(handHeld), small);
    ASSERT_TRUE(right);
    EXPECT_NEAR(*right, 1, 0.1);
    for (StampedPose& pose : small.front()) pose.T_world_cam.t /= 5;
    const auto five = scaleByAccelerometer(accelerometer(handHeld), small);
    ASSERT_TRUE(five);
    EXPECT_NEAR(*five, 5, 0.5);
    EXPECT_FALSE(scaleByAccelerometer(accelerometer(standing), track(standing)));
}

TEST(ImuRemedy, poseIsThatOfTheAxesAsTheyAre) {
    // An IMU whose x looks where its mount says y is: 90 degrees about z.
    const Eigen::Matrix3d turn = rotationExp({0, 0, M_PI / 2});
    SensorVerdict verdict;
    verdict.fault = SensorFault::Axes;
    verdict.axes = turn;
    EXPECT_EQ(imuRemedy(verdict, {}, true), "import with imu_pose = [0 0 0 90 0 0] in camera.ini");
}

struct OdometryFault {
    std::string name, remedy;
    std::function<Eigen::Vector3d(Eigen::Vector3d)> change;
};

/** As MRPT keeps headings. */
double wrapped(double heading) {
    return std::remainder(heading, 2 * M_PI);
}

std::vector<OdometryFault> odometryFaults() {
    using V = Eigen::Vector3d;
    return {
        {"in mm", "--odometry-unit mm", [](V v) { return V(1000 * v[0], 1000 * v[1], v[2]); }},
        {"in cm", "--odometry-unit cm", [](V v) { return V(100 * v[0], 100 * v[1], v[2]); }},
        {"in deg", "--odometry-heading-unit deg",
         [](V v) { return V(v[0], v[1], wrapped(v[2] / degree)); }},
        {"negated", "--odometry-unit=-1", [](V v) { return V(-v[0], -v[1], v[2]); }},
        {"exchanged", "", [](V v) { return V(v[1], v[0], v[2]); }},
        {"y is negated", "", [](V v) { return V(v[0], -v[1], v[2]); }},
        {"turned by 90 degrees", "", [](V v) { return V(-v[1], v[0], v[2]); }},
        {"heading turns the other way", "--odometry-heading-unit=-1",
         [](V v) { return V(v[0], v[1], -v[2]); }},
        {"in mm", "--odometry-unit mm and --odometry-heading-unit deg",
         [](V v) { return V(1000 * v[0], 1000 * v[1], wrapped(v[2] / degree)); }},
        {"stand still", "", [](V) { return V(0, 0, 0); }},
    };
}

TEST(OdometryCheck, agreesWithTheRobotItDrives) {
    const auto verdict = checkOdometry(odometry(driving), track(driving), 5000);
    EXPECT_EQ(verdict.fault, SensorFault::None) << verdict.finding;
}

TEST(OdometryCheck, eachFaultIsNamedWithItsRemedy) {
    const TrackedStretches base = track(driving);
    for (const OdometryFault& fault : odometryFaults()) {
        const auto verdict = checkOdometry(changed(odometry(driving), fault.change), base, 5000);
        EXPECT_TRUE(verdict.wrong()) << fault.name;
        EXPECT_NE(verdict.finding.find(fault.name), std::string::npos)
            << fault.name << ": " << verdict.finding;
        if (fault.remedy.empty()) continue;
        EXPECT_EQ(odometryRemedy(verdict), "import with " + fault.remedy) << verdict.finding;
    }
}

TEST(OdometryCheck, unitOfDepthIsSuspectedAsWell) {
    TrackedStretches small = track(driving, 0.0005);
    for (StampedPose& pose : small.front()) pose.T_world_cam.t /= 5;
    const auto verdict = checkOdometry(odometry(driving), small, 5000);
    EXPECT_EQ(verdict.fault, SensorFault::Unit);
    EXPECT_NEAR(verdict.factor, 5, 0.3);
    EXPECT_NE(verdict.finding.find("depth_units should be"), std::string::npos) << verdict.finding;
}

TEST(OdometryCheck, nothingIsSaidOfARobotThatStands) {
    EXPECT_FALSE(checkOdometry(odometry(driving), {}, 5000).wrong());
    EXPECT_FALSE(checkOdometry(times(1000, odometry(standing)), track(standing), 5000).wrong());
}

TEST(GyroscopeCheck, MeasuresDelaysToTheNearestMilliseconds) {
    const auto same = [](const Eigen::Vector3d& v) { return v; };
    for (const double delay_s : {-0.433, -0.0217, -0.003, 0.0, 0.0084, 0.05, 0.291, 0.48}) {
        const SensorVerdict verdict =
            checkGyroscope(changed(gyroscope(handHeld), same, delay_s), track(handHeld));
        ASSERT_TRUE(verdict.measured_delay) << delay_s;
        EXPECT_NEAR(verdict.measured_delay->delay_s, delay_s, 0.0015);
        EXPECT_LT(verdict.measured_delay->sigma_s, 0.0035);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
