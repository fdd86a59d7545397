/** Wheels, gyroscope and GPS of made drives. */
#include "rgbd_graphslam/fusion/gps_fusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../support/random_inputs.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/fusion/geo_alignment.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;

constexpr double yard_lat_deg = 48.1, yard_lon_deg = 11.6;

struct Yard {
    GpsFusionInput input;
    Trajectory truth;  // east, north, up of the first true antenna place
    LocalTangentPlane plane{{yard_lat_deg, yard_lon_deg, 500}};
};

/** Circles and straights over 40 x 40 m at 1 m/s: (x, y, yaw). */
Eigen::Vector3d place(double s) {
    const double x = 20 * std::sin(0.05 * s), y = 15 * std::sin(0.1 * s);
    const double dx = std::cos(0.05 * s), dy = 1.5 * std::cos(0.1 * s);
    return {x, y, std::atan2(dy, dx)};
}

Yard drive(unsigned seed, double sigma_m, double gyro_bias = 0.01, double yaw_scale = 0.7) {
    constexpr double end_s = 300, rate_hz = 20;
    RandomInputs random(seed);
    Yard yard;
    yard.input.lever_arm = {0.4, 0.1, 0.6};
    PlanarPose wheels;
    for (int i = 0; i <= end_s * rate_hz; ++i) {
        const double s = i / rate_hz;
        const Eigen::Vector3d p = place(s), next = place(s + 1 / rate_hz);
        const SE3 pose(rotationExp({0, 0, p.z()}), {p.x(), p.y(), 0});
        yard.truth.push_back({s, pose});
        yard.input.wheels.push_back({s, wheels});
        const double turn = std::remainder(next.z() - p.z(), 2 * M_PI);
        const double way = (next - p).head<2>().norm() * (1.01 + 0.03 * random.gauss());
        wheels = wheels * PlanarPose{way, 0, yaw_scale * turn + 0.001 * random.gauss()};
        const double rate = (turn * rate_hz) + gyro_bias + 0.002 * random.gauss();
        yard.input.imu.push_back({s, {0, 0, rate}, {0, 0, 9.81}});
        if (i % 8 != 0) continue;
        const Eigen::Vector3d noise(random.gauss(), random.gauss(), 2 * random.gauss());
        const Eigen::Vector3d antenna = pose * yard.input.lever_arm + sigma_m * noise;
        yard.input.fixes.push_back(
            {s, yard.plane.toGeodetic(antenna), {sigma_m, sigma_m, 2 * sigma_m}});
    }
    return yard;
}

/** Of positions in the plane, root mean square. */
double rmse(const GpsFusionResult& result, const Yard& yard) {
    double sum = 0;
    for (const StampedPose& pose : result.trajectory) {
        const Eigen::Vector3d enu = yard.plane.toEnu(result.plane.toGeodetic(pose.T_world_cam.t));
        sum += (enu - poseAt(yard.truth, pose.stamp_s)->t).head<2>().squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(result.trajectory.size()));
}

double worstYawDeg(const GpsFusionResult& result, const Yard& yard) {
    std::vector<double> all;
    for (const StampedPose& pose : result.trajectory) {
        const Eigen::Matrix3d off =
            poseAt(yard.truth, pose.stamp_s)->R.transpose() * pose.T_world_cam.R;
        all.push_back(std::abs(std::atan2(off(1, 0), off(0, 0))));
    }
    std::sort(all.begin(), all.end());
    return all[all.size() * 9 / 10] * 180 / M_PI;
}

TEST(GpsFusion, followsARobotThroughAYard) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        const Yard yard = drive(seed, 1.5);
        const GpsFusionResult result = fuseGps(yard.input, {});
        EXPECT_LT(rmse(result, yard), 0.45) << "seed " << seed;
        EXPECT_LT(worstYawDeg(result, yard), 1.5) << "seed " << seed;
        EXPECT_NEAR(result.gyro_bias_rad_s, 0.01, 0.0005);
        EXPECT_NEAR(result.used.whitened_rms, 1, 0.1);
    }
}

TEST(GpsFusion, heldOutFixesAreAsNearAsTheirNoise) {
    const Yard yard = drive(6, 1.5);
    GpsOptions options;
    options.hold_out_every = 2;
    const GpsFusionResult result = fuseGps(yard.input, options);
    EXPECT_NEAR(static_cast<double>(result.held_out.fixes), static_cast<double>(result.used.fixes),
                1);
    EXPECT_LT(result.held_out.horizontal_rms_m, result.held_out.claimed_rms_m + 0.2);
    EXPECT_GT(result.held_out.horizontal_rms_m, 0.8 * result.held_out.claimed_rms_m);
}

TEST(GpsFusion, survivesMultipathAndAnOutage) {
    Yard yard = drive(7, 1);
    auto& fixes = yard.input.fixes;
    for (std::size_t i = 100; i < 110; ++i) {
        fixes[i].place =
            yard.plane.toGeodetic(yard.plane.toEnu(fixes[i].place) + Eigen::Vector3d(25, -10, 5));
    }
    fixes.erase(fixes.begin() + 200, fixes.begin() + 225);  // 10 s
    const GpsFusionResult result = fuseGps(yard.input, {});
    EXPECT_LT(rmse(result, yard), 0.35);
    EXPECT_GE(result.used.outliers, 10u);
}

TEST(GpsFusion, tellsOfAGyroscopeWithTurnedAxes) {
    Yard yard = drive(8, 1, 0, 1);
    for (ImuSample& sample : yard.input.imu) sample.gyro = -sample.gyro;
    const GpsFusionResult result = fuseGps(yard.input, {});
    EXPECT_THAT(result.gyroscope_refused, HasSubstr("is -0.99 times that of the wheels"));
    EXPECT_LT(rmse(result, yard), 0.5);
}

template <class Function>
std::string refusal(Function function) {
    try {
        function();
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(GpsFusion, saysWhatIsMissing) {
    Yard yard = drive(9, 1);
    GpsFusionInput input = yard.input;
    input.wheels.clear();
    EXPECT_THAT(refusal([&] { fuseGps(input, {}); }), HasSubstr("without wheel odometry"));
    input = yard.input;
    for (GpsFix& fix : input.fixes) fix.stamp_s += 1e6;
    EXPECT_THAT(refusal([&] { fuseGps(input, {}); }), HasSubstr("only 0 usable GPS fixes"));
    input = yard.input;
    input.wheels.erase(input.wheels.begin() + 100, input.wheels.begin() + 200);
    EXPECT_THAT(refusal([&] { fuseGps(input, {}); }), HasSubstr("gap of more than 2 s"));
    input = yard.input;
    for (WheelSample& sample : input.wheels) sample.T_start_base = {};
    input.lever_arm.setZero();
    EXPECT_THAT(refusal([&] { fuseGps(input, {}); }), HasSubstr("stays within 5 m"));
}

TEST(GeoAlignment, findsHeadingAndPlaceInSpiteOfOutliers) {
    RandomInputs random(11);
    const SE3 T(rotationExp({0, 0, 2.1}), {100, -40, 3});
    std::vector<PlacePair> pairs;
    for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d p = random.vector(20);
        pairs.push_back({p, T * p + 0.3 * Eigen::Vector3d(random.gauss(), random.gauss(), 0), 0.3});
        if (i % 10 == 0) pairs.back().enu += Eigen::Vector3d(30, 10, 0);
    }
    const auto found = alignLevel(pairs);
    ASSERT_TRUE(found);
    EXPECT_LT((found->t - T.t).head<2>().norm(), 0.2);
    EXPECT_LT((found->R.transpose() * T.R - Eigen::Matrix3d::Identity()).norm(), 0.02);
    for (PlacePair& pair : pairs) pair.map *= 0.01;
    EXPECT_FALSE(alignLevel(pairs));
}

}  // namespace
}  // namespace rgbd_graphslam
