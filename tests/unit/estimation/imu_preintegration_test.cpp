#include "rgbd_graphslam/estimation/imu_preintegration.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "../../support/random_inputs.h"
#include "ride.h"

namespace rgbd_graphslam {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

ImuBias someBias(RandomInputs& random, double size = 1) {
    return {random.vector(0.05 * size), random.vector(0.2 * size)};
}

/** (position, rotation, velocity) of b against a, the rotation on the right. */
Vector9 difference(const ImuIncrement& b, const ImuIncrement& a) {
    Vector9 d;
    d << b.T_from_to.t - a.T_from_to.t, rotationLog(a.T_from_to.R.transpose() * b.T_from_to.R),
        b.velocity - a.velocity;
    return d;
}

TEST(ImuPreintegration, givesTheMotionOfARide) {
    const Ride ride;
    for (const double from_s : {0.0, 1.2345, 3.3}) {
        const double to_s = from_s + 0.4321;
        const auto increment = preintegrate(ride.samples(from_s, to_s), from_s, to_s, {}, {});
        ASSERT_TRUE(increment);
        const double dt = increment->duration_s;
        EXPECT_NEAR(dt, 0.4321, 1e-12);
        const SE3 from = ride.T_world_imu(from_s), to = ride.T_world_imu(to_s);
        const Eigen::Vector3d position = from.t + ride.velocity(from_s) * dt +
                                         0.5 * dt * dt * ride.gravity +
                                         from.R * increment->T_from_to.t;
        const Eigen::Vector3d velocity =
            ride.velocity(from_s) + dt * ride.gravity + from.R * increment->velocity;
        EXPECT_LT((position - to.t).norm(), 1e-5);
        EXPECT_LT((velocity - ride.velocity(to_s)).norm(), 1e-5);
        EXPECT_LT(rotationLog(to.R.transpose() * from.R * increment->T_from_to.R).norm(), 1e-5);
    }
}

TEST(ImuPreintegration, goesOnWhereAnIncrementEnds) {
    const Ride ride;
    const auto samples = ride.samples(0, 1);
    const auto first = preintegrate(samples, 0, 0.4567, {}, {}),
               second = preintegrate(samples, 0.4567, 1, {}, {}),
               whole = preintegrate(samples, 0, 1, {}, {});
    ASSERT_TRUE(first && second && whole);
    const double dt = second->duration_s;
    const Eigen::Matrix3d& R = first->T_from_to.R;
    EXPECT_LT((R * second->T_from_to.R - whole->T_from_to.R).norm(), 1e-6);
    EXPECT_LT(
        (first->T_from_to.t + first->velocity * dt + R * second->T_from_to.t - whole->T_from_to.t)
            .norm(),
        1e-6);
}

TEST(ImuPreintegration, interpolatesBothEnds) {
    std::vector<ImuSample> samples;
    for (int i = 0; i < 5; ++i) samples.push_back({0.02 * i, {0, 0, 0.02 * i}, {0, 0, 0}});
    const auto increment = preintegrate(samples, 0.013, 0.067, {}, {});
    ASSERT_TRUE(increment);
    const double expected = (0.067 * 0.067 - 0.013 * 0.013) / 2;  // of a rate that rises with time
    EXPECT_NEAR(rotationLog(increment->T_from_to.R).z(), expected, 1e-12);
    EXPECT_NEAR(increment->duration_s, 0.054, 1e-12);
}

TEST(ImuPreintegration, refusesGapsAndWhatDoesNotReachTheEnds) {
    auto samples = Ride().samples(0, 1, 100);
    EXPECT_TRUE(preintegrate(samples, 0, 1, {}, {}));
    EXPECT_FALSE(preintegrate(samples, -0.1, 0.5, {}, {})) << "begins too late";
    EXPECT_FALSE(preintegrate(samples, 0.5, 1.1, {}, {})) << "ends too early";
    EXPECT_FALSE(preintegrate(samples, 0.5, 0.5, {}, {})) << "no time";
    EXPECT_FALSE(preintegrate({}, 0, 1, {}, {}));
    auto with_gap = samples;
    with_gap.erase(with_gap.begin() + 40, with_gap.begin() + 46);
    EXPECT_FALSE(preintegrate(with_gap, 0, 1, {}, {}));
    EXPECT_TRUE(preintegrate(with_gap, 0, 0.3, {}, {})) << "the gap is elsewhere";
    samples[50].stamp_s = samples[49].stamp_s;
    EXPECT_FALSE(preintegrate(samples, 0, 1, {}, {})) << "a stamp repeats";
}

TEST(ImuPreintegration, derivativeByTheBiasIsNumeric) {
    RandomInputs random(1);
    const auto samples = Ride().samples(0, 0.5);
    for (int trial = 0; trial < 10; ++trial) {
        const ImuBias bias = someBias(random);
        const auto increment = preintegrate(samples, 0, 0.5, bias, {});
        for (int i = 0; i < 6; ++i) {
            constexpr double h = 1e-6;
            const auto moved = [&](double step) {
                ImuBias b = bias;
                (i < 3 ? b.gyro(i) : b.accelerometer(i - 3)) += step;
                return difference(*preintegrate(samples, 0, 0.5, b, {}), *increment);
            };
            const Vector9 numeric = (moved(h) - moved(-h)) / (2 * h);
            EXPECT_LT((increment->by_bias.col(i) - numeric).norm(), 1e-7) << i;
        }
    }
}

TEST(ImuPreintegration, correctsForAnotherBiasToFirstOrder) {
    RandomInputs random(2);
    const auto samples = Ride().samples(0, 0.5);
    const auto increment = preintegrate(samples, 0, 0.5, {}, {});
    const auto errorAfter = [&](const ImuBias& bias) {
        const auto again = preintegrate(samples, 0, 0.5, bias, {});
        return difference(increment->corrected(bias), *again).norm();
    };
    const ImuBias bias = someBias(random);
    const double whole = errorAfter(bias);
    const double half = errorAfter({bias.gyro / 2, bias.accelerometer / 2});
    EXPECT_LT(whole, 2e-3);
    EXPECT_NEAR(whole / half, 4, 0.3) << "what is left is quadratic";
}

TEST(ImuPreintegration, covarianceIsThatOfNoisyReadings) {
    constexpr int trials = 1500;
    constexpr double rate_hz = 200;
    RandomInputs random(3);
    const ImuNoise noise{2e-3, 3e-2, 0, 0};
    const auto exact = Ride().samples(0, 0.5, rate_hz);
    const auto expected = preintegrate(exact, 0, 0.5, {}, noise);
    Matrix9d scatter = Matrix9d::Zero();
    for (int t = 0; t < trials; ++t) {
        auto noisy = exact;
        const auto white = [&](double density) {
            return Eigen::Vector3d(density * std::sqrt(rate_hz) *
                                   Eigen::Vector3d(random.gauss(), random.gauss(), random.gauss()));
        };
        for (ImuSample& s : noisy) {
            s.gyro += white(noise.gyro);
            s.accelerometer += white(noise.accelerometer);
        }
        const Vector9 d = difference(*preintegrate(noisy, 0, 0.5, {}, noise), *expected);
        scatter += d * d.transpose() / trials;
    }
    const Matrix9d ratio = expected->covariance.llt().solve(scatter);
    EXPECT_NEAR(ratio.trace() / 9, 1, 0.06) << "mean squared error over its covariance";
    for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(std::sqrt(scatter(i, i) / expected->covariance(i, i)), 1, 0.08) << i;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
