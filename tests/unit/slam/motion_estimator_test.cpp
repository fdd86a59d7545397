#include "../../../libs/slam/src/motion_estimator.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>

#include "rgbd_graphslam/core/byte_stream.h"
#include "sensor_ride.h"

namespace rgbd_graphslam {
namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

TEST(MotionEstimator, KnowsNothingBeforeHalfASecond) {
    SensorRide ride("office", 1);
    ride.drive(0.4);
    EXPECT_FALSE(ride.estimator().predicted());
    ride.drive(0.4);
    EXPECT_TRUE(ride.estimator().predicted());
    EXPECT_TRUE(ride.estimator().summary().imu_used);
}

TEST(MotionEstimator, KnowsNothingWithoutAnImu) {
    SensorRide ride("long-run", 1);
    ride.has_imu = false;
    ride.drive(5);
    EXPECT_FALSE(ride.estimator().predicted());
    EXPECT_EQ(ride.estimator().summary().imu_readings, 0u);
}

TEST(MotionEstimator, PredictsTheNextFrameToMillimeters) {
    SensorRide ride("desk", 1);
    ride.drive(4);
    for (int i = 0; i < 60; ++i) {
        ride.next();
        EXPECT_LT(ride.error().head<3>().norm(), 0.015);
        EXPECT_LT(ride.error().tail<3>().norm(), 0.008);
    }
}

TEST(MotionEstimator, FindsTheBiasesWithinTenSeconds) {
    std::vector<double> gyro, accelerometer;
    for (std::uint64_t seed = 1; seed <= 15; ++seed) {
        SensorRide ride("blackout", seed);
        ride.drive(10);
        const MotionSummary& summary = ride.estimator().summary();
        gyro.push_back((summary.bias.gyro - ride.bias().tail<3>()).norm());
        accelerometer.push_back((summary.bias.accelerometer - ride.bias().head<3>()).norm());
    }
    std::printf("gyro bias off by %.5f (worst %.5f) rad/s, accelerometer's by %.4f (%.4f) m/s^2\n",
                median(gyro), *std::max_element(gyro.begin(), gyro.end()), median(accelerometer),
                *std::max_element(accelerometer.begin(), accelerometer.end()));
    EXPECT_LT(median(gyro), 5e-4);
    EXPECT_LT(median(accelerometer), 0.02);
}

/** Errors of position and squared Mahalanobis distances per degree of freedom of blind ends. */
struct BlindEnds {
    std::vector<double> off_m, nees;
    void take(const SensorRide& ride) {
        const Vector6d error = ride.error();
        off_m.push_back(error.head<3>().norm());
        nees.push_back(error.dot(ride.estimator().predicted()->covariance.inverse() * error) / 6);
    }
    void print(const char* what) const {
        double mean = 0;
        for (const double n : nees) mean += n / static_cast<double>(nees.size());
        std::printf("%s: median %.4f m, worst %.4f m, NEES per degree of freedom %.2f\n", what,
                    median(off_m), *std::max_element(off_m.begin(), off_m.end()), mean);
    }
};

TEST(MotionEstimator, CrossesABlackoutInTheHand) {
    BlindEnds after_2s, after_5s;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SensorRide ride("blackout", seed);
        ride.drive(15);
        ride.drive(2, true);
        ASSERT_TRUE(ride.estimator().predicted());
        after_2s.take(ride);
        ride.drive(3, true);
        ASSERT_TRUE(ride.estimator().predicted());
        after_5s.take(ride);
    }
    after_2s.print("after 2 s");
    after_5s.print("after 5 s");
    EXPECT_LT(median(after_2s.off_m), 0.03);
    EXPECT_LT(median(after_5s.off_m), 0.15);
    EXPECT_LT(median(after_5s.nees), 2);
}

TEST(MotionEstimator, CrossesABlackoutOnWheels) {
    BlindEnds ends;
    std::vector<double> beyond;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SensorRide ride("blackout-robot", seed);
        ride.drive(22);
        double way = 0;
        SE3 last = ride.truth();
        for (int i = 0; i < 300; ++i) {
            ride.next(true);
            way += (ride.truth() * last.inverse()).t.norm();
            last = ride.truth();
        }
        ASSERT_TRUE(ride.estimator().predicted());
        ends.take(ride);
        beyond.push_back(ends.off_m.back() - 0.01 * way - 0.02);
    }
    ends.print("10 s on wheels");
    EXPECT_LT(median(beyond), 0);
    EXPECT_LT(median(ends.nees), 2);
}

TEST(MotionEstimator, EstimatesTheBlindStretchAgainWhenItEnds) {
    SensorRide ride("blackout", 3);
    ride.drive(15);
    const double begins = ride.time();
    ride.drive(5, true);
    const double before = ride.error().head<3>().norm();
    ride.drive(0.2);
    const auto revised = ride.estimator().takeRevised();
    ASSERT_GT(revised.size(), 20u);
    EXPECT_LE(revised.front().first, 1000 + begins + 1e-6);
    double worst = 0;
    for (const auto& [stamp_s, T_cam_world] : revised) {
        worst =
            std::max(worst, T_cam_world.minus(ride.T_cam_world(stamp_s - 1000)).head<3>().norm());
    }
    EXPECT_LT(worst, std::max(0.02, 0.7 * before));
    EXPECT_TRUE(ride.estimator().takeRevised().empty());
}

TEST(MotionEstimator, TellsSlipsFromTheWay) {
    double slipped_s = 0, found_s = 0, held_s = 0, false_s = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SensorRide ride("wheel-slip", seed);
        ride.drive(25);
        const auto& slips = ride.world().slips;
        const auto& found = ride.estimator().summary().slips;
        const auto within = [](double t, const auto& spans, const auto& bounds) {
            return std::any_of(spans.begin(), spans.end(), [&](const auto& span) {
                const auto [from, to] = bounds(span);
                return t >= from && t <= to;
            });
        };
        for (double t = 2; t < 24; t += 0.02) {
            // Half an interval of the estimator at either end belongs to both.
            const bool slip = within(t, slips, [](const auto& s) {
                return std::pair{s.from_s + 0.1, s.to_s - 0.1};
            });
            const bool holds = !within(t, slips, [](const auto& s) {
                return std::pair{s.from_s - 0.2, s.to_s + 0.2};
            });
            const bool told = within(1000 + t, found, [](const auto& s) { return s; });
            slipped_s += slip;
            found_s += slip && told;
            held_s += holds;
            false_s += holds && told;
        }
    }
    std::printf("slip found %.1f %%, false %.2f %%\n", 100 * found_s / slipped_s,
                100 * false_s / held_s);
    EXPECT_GT(found_s, 0.95 * slipped_s);
    EXPECT_LT(false_s, 0.01 * held_s);
}

TEST(MotionEstimator, LearnsTheWheelsRadius) {
    SensorRide ride("long-run", 5);
    ride.drive(40);
    const MotionSummary& summary = ride.estimator().summary();
    EXPECT_NEAR(summary.wheel_scale, 1, 0.03);
    EXPECT_LT(summary.wheel_scale_sigma, 0.006);
    EXPECT_GT(summary.wheels_compared, 150u);
    EXPECT_GT(summary.wheels.mean(), 0.5);
    EXPECT_LT(summary.wheels.mean(), 1.5);
}

TEST(MotionEstimator, BeginsAgainAfterAGapWithTheBiasesItKnew) {
    SensorRide ride("blackout", 2);
    ride.drive(10);
    const ImuBias known = ride.estimator().summary().bias;
    ride.has_imu = false;
    ride.drive(1);
    EXPECT_FALSE(ride.estimator().predicted());
    ride.has_imu = true;
    ride.drive(2);
    ASSERT_TRUE(ride.estimator().predicted());
    EXPECT_EQ(ride.estimator().summary().restarts, 1);
    EXPECT_LT((ride.estimator().summary().bias.gyro - known.gyro).norm(), 1e-3);
}

TEST(MotionEstimator, RefusesAGyroscopeInDegrees) {
    SensorRide ride("desk", 4);
    ride.rate_unit = 180 / M_PI;
    ride.drive(3);
    EXPECT_FALSE(ride.estimator().predicted());
    EXPECT_FALSE(ride.estimator().summary().imu_used);
}

TEST(MotionEstimator, LeavesOutWhatIsNotWanted) {
    SensorRide ride("office", 4);
    ride.options_.use_imu = false;
    ride.drive(3);
    EXPECT_FALSE(ride.estimator().predicted());
}

TEST(MotionEstimator, MovesWithItsKeyframe) {
    SensorRide ride("office", 6);
    ride.drive(3);
    const SE3 T_new_old(rotationExp({0.1, 0.2, 0.3}), {1, 2, 3});
    ride.map().setPose(0, ride.map().T_cam_world(0) * T_new_old.inverse());
    ride.next(true);
    const SE3 expected = ride.truth() * T_new_old.inverse();
    EXPECT_LT(ride.estimator().predicted()->T_cam_world.minus(expected).norm(), 0.02);
}

TEST(MotionEstimator, GoesOnToTheSameBitsFromItsSavedState) {
    for (const double stop_s : {0.3, 6.0, 17.03}) {
        SensorRide ride("blackout-robot", 7);
        ride.drive(std::min(stop_s, 15.0));
        if (stop_s > 15) ride.drive(stop_s - 15, true);
        ByteWriter saved;
        ride.estimator().save(saved);
        MotionEstimator loaded(ride.options_, ride.map());
        ByteReader in(saved.bytes());
        loaded.load(in);
        ByteWriter again;
        loaded.save(again);
        EXPECT_EQ(again.bytes(), saved.bytes());
        Frame frame, same;
        same.stamp_s = frame.stamp_s = 1000 + ride.time() + 0.02;
        ride.estimator().note(frame);
        loaded.note(same);
        ASSERT_EQ(frame.reckoning.T_odometry_cam.has_value(),
                  same.reckoning.T_odometry_cam.has_value());
        if (frame.reckoning.T_odometry_cam) {
            EXPECT_EQ(frame.reckoning.T_odometry_cam->t, same.reckoning.T_odometry_cam->t);
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam
