#include "rgbd_graphslam/fusion/gps_fusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/estimation/heading_increment.h"
#include "rgbd_graphslam/estimation/motion_state_prior.h"
#include "rgbd_graphslam/estimation/pose_prior.h"
#include "rgbd_graphslam/estimation/position_measurement.h"
#include "rgbd_graphslam/estimation/relative_pose.h"
#include "rgbd_graphslam/estimation/wheel_factor.h"
#include "rgbd_graphslam/fusion/geo_alignment.h"

namespace rgbd_graphslam {
namespace {

constexpr double longest_wheel_gap_s = 2, longest_imu_gap_s = 0.5;

SE3 lifted(const PlanarPose& pose) {
    return {rotationExp({0, 0, pose.yaw}), Eigen::Vector3d(pose.x, pose.y, 0)};
}

WheelNoise wheelNoise(const GpsOptions& options, bool has_gyroscope) {
    WheelNoise noise;
    noise.forward_m2_per_m = noise.sideways_m2_per_m = std::pow(options.wheel_slip_share, 2);
    noise.yaw_rad2_per_rad = std::pow(options.wheel_yaw_share, 2);
    noise.yaw_rad2_per_m = 1e-3;
    // At rest wheels say that nothing moves, but a robot that slides or is pushed does.
    noise.least_sigma_m = 5e-3;
    noise.least_sigma_rad = has_gyroscope ? 2e-2 : 2e-3;
    return noise;
}

/** A stretch between two keyframes. */
struct Stretch {
    double from_s, to_s;
    WheelIncrement wheels;
    std::optional<double> turned_rad;  // by the gyroscope
};

/** Rates about the vertical, which the accelerometer tells however the sensor is mounted: over a
 *  long drive on level ground its mean is gravity's reaction. The base's z axis where that is not
 *  measured. */
std::vector<ImuSample> aboutVertical(const std::vector<ImuSample>& imu) {
    constexpr double least_m_s2 = 8, most_m_s2 = 12;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const ImuSample& sample : imu) {
        mean += sample.accelerometer / static_cast<double>(imu.size());
    }
    if (mean.norm() < least_m_s2 || mean.norm() > most_m_s2) return imu;
    const Eigen::Matrix3d R =
        Eigen::Quaterniond::FromTwoVectors(mean, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    std::vector<ImuSample> upright = imu;
    for (ImuSample& sample : upright) {
        sample.gyro = R * sample.gyro;
        sample.accelerometer = R * sample.accelerometer;
    }
    return upright;
}

/** Rate about z, by the trapezium rule, interpolated at both ends; nothing across gaps. */
std::optional<double> integratedYaw(const std::vector<ImuSample>& imu, double from_s, double to_s) {
    const auto later = [](const ImuSample& sample, double stamp_s) {
        return sample.stamp_s < stamp_s;
    };
    auto at = std::lower_bound(imu.begin(), imu.end(), from_s, later);
    if (at == imu.begin()) return std::nullopt;
    double sum = 0;
    for (--at; at + 1 != imu.end(); ++at) {
        const ImuSample &a = *at, &b = *(at + 1);
        const double step_s = b.stamp_s - a.stamp_s;
        if (step_s > longest_imu_gap_s) return std::nullopt;
        const double begin_s = std::max(a.stamp_s, from_s), end_s = std::min(b.stamp_s, to_s);
        const auto rate = [&](double stamp_s) {
            return a.gyro.z() + (stamp_s - a.stamp_s) / step_s * (b.gyro.z() - a.gyro.z());
        };
        sum += 0.5 * (rate(begin_s) + rate(end_s)) * (end_s - begin_s);
        if (b.stamp_s >= to_s) return sum;
    }
    return std::nullopt;
}

/** Why a gyroscope contradicts the wheels: turned axes or another unit. Empty when it does not. */
std::string complaint(const std::vector<Stretch>& stretches) {
    constexpr double least_turn_rad2 = 0.5;
    double both = 0, wheels = 0;
    for (const Stretch& stretch : stretches) {
        if (!stretch.turned_rad) continue;
        both += stretch.wheels.T_from_to.yaw * *stretch.turned_rad;
        wheels += std::pow(stretch.wheels.T_from_to.yaw, 2);
    }
    if (wheels < least_turn_rad2) return {};
    const double ratio = both / wheels;
    if (ratio > 0.4 && ratio < 2.5) return {};
    return formatted(
        "its rate about the vertical is %.2f times that of the wheels; check the IMU's "
        "sensorPose and the unit of its rates",
        ratio);
}

class Fusion {
  public:
    Fusion(const GpsFusionInput& input, const GpsOptions& options)
        : input_(input), options_(options), imu_(aboutVertical(input.imu)) {
        chooseFixes();
        measureStretches();
        correctWheelScale();
        layOverFixes();
    }

    GpsFusionResult solve() {
        addFactors();
        // Fixes that are far off because the start is must not be taken for outliers.
        constexpr double patient_sigmas = 100;
        minimize(patient_sigmas);
        minimize(options_.outlier_sigmas);
        GpsFusionResult result;
        result.plane = plane_;
        result.gyro_bias_rad_s = problem_.states.keyframes.front().motion.gyro_bias.z();
        result.gyroscope_refused = refused_;
        result.wheel_scale = wheel_scale_;
        describe(result);
        return result;
    }

  private:
    struct Node {
        double stamp_s;
        Eigen::Vector3d enu, sigma_m;
        bool held_out;
    };

    bool isHeldOut(std::size_t i) const {
        const auto every = static_cast<std::size_t>(options_.hold_out_every);
        return every > 1 && i % every == every - 1;
    }

    /** Those that the wheels reach. */
    void chooseFixes() {
        if (input_.wheels.size() < 2) {
            throw Error("GPS without wheel odometry (CObservationOdometry) gives no poses",
                        "record the odometry, too");
        }
        for (std::size_t i = 0; i < input_.fixes.size(); ++i) {
            const GpsFix& fix = input_.fixes[i];
            if (fix.stamp_s < input_.wheels.front().stamp_s ||
                fix.stamp_s > input_.wheels.back().stamp_s) {
                continue;
            }
            if (nodes_.empty()) plane_ = LocalTangentPlane(fix.place);
            nodes_.push_back({fix.stamp_s, plane_.toEnu(fix.place), fix.sigma_m, isHeldOut(i)});
        }
        if (nodes_.size() >= 3) return;
        throw Error(formatted("only %zu usable GPS fixes lie within the time of the odometry",
                              nodes_.size()),
                    "check the stamps of both, and that the receiver had a fix");
    }

    void measureStretches() {
        const bool has_gyroscope = !input_.imu.empty();
        for (std::size_t k = 1; k < nodes_.size(); ++k) {
            const double from_s = nodes_[k - 1].stamp_s, to_s = nodes_[k].stamp_s;
            const auto wheels =
                preintegrate(input_.wheels, from_s, to_s, wheelNoise(options_, has_gyroscope),
                             longest_wheel_gap_s);
            if (!wheels) {
                throw Error(formatted("the wheel odometry has a gap of more than %g s between "
                                      "%.3f and %.3f s, or its stamps go back",
                                      longest_wheel_gap_s, from_s, to_s),
                            "cut the recording there");
            }
            stretches_.push_back({from_s, to_s, *wheels, integratedYaw(imu_, from_s, to_s)});
        }
        refused_ = complaint(stretches_);
        if (refused_.empty()) return;
        for (Stretch& stretch : stretches_) stretch.turned_rad.reset();
    }

    /** Wheels' way with the gyroscope's turns, from the first keyframe. */
    std::vector<SE3> deadReckoned() const {
        std::vector<SE3> poses{SE3()};
        for (const Stretch& stretch : stretches_) {
            PlanarPose motion = stretch.wheels.T_from_to;
            if (stretch.turned_rad) motion.yaw = *stretch.turned_rad;
            poses.push_back(poses.back() * lifted(motion));
        }
        return poses;
    }

    /** Distances between fixes over those between the same moments by the wheels, in the median:
     *  tires wear, and wheels that turn by skidding go less far than they roll. */
    void correctWheelScale() {
        constexpr double least_m = 10, longest_m = 30, farthest_off = 0.3;
        constexpr std::size_t least_pairs = 20;
        const std::vector<SE3> poses = deadReckoned();
        std::vector<double> ratios;
        for (std::size_t i = 0, j = 0; i < nodes_.size(); ++i) {
            const auto byWheels = [&] { return (poses[j].t - poses[i].t).head<2>().norm(); };
            for (j = std::max(i, j); j + 1 < nodes_.size() && byWheels() < least_m;) ++j;
            if (nodes_[i].held_out || nodes_[j].held_out) continue;
            const double wheels_m = byWheels();
            if (wheels_m < least_m || wheels_m > longest_m) continue;
            ratios.push_back((nodes_[j].enu - nodes_[i].enu).head<2>().norm() / wheels_m);
        }
        if (ratios.size() < least_pairs) return;
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        if (std::abs(*middle - 1) > farthest_off) {
            throw Error(
                formatted("the wheels' ways must be multiplied by %.2f to fit GPS", *middle),
                "check the unit of the odometry");
        }
        wheel_scale_ = *middle;
        for (Stretch& stretch : stretches_) {
            stretch.wheels.T_from_to.x *= wheel_scale_;
            stretch.wheels.T_from_to.y *= wheel_scale_;
        }
    }

    /** Lays the dead reckoning over the fixes. */
    void layOverFixes() {
        std::vector<PlacePair> pairs;
        const std::vector<SE3> poses = deadReckoned();
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            if (nodes_[k].held_out) continue;
            pairs.push_back({poses[k] * input_.lever_arm, nodes_[k].enu, nodes_[k].sigma_m.x()});
        }
        const auto T_enu_start = alignLevel(pairs);
        if (!T_enu_start) {
            throw Error("the robot stays within 5 m: GPS does not tell its heading",
                        "record a longer way");
        }
        for (const SE3& pose : poses) {
            problem_.states.keyframes.push_back({(*T_enu_start * pose).inverse(), {}});
        }
        problem_.free_keyframes = static_cast<int>(poses.size());
    }

    /** What holds height, roll and pitch: ground that is level and even within a little. */
    static Matrix6d evenGround(double way_m) {
        constexpr double slope_sigma = 0.05, least_m = 0.01, tilt_sigma_rad = 0.02, unknown = 1e-6;
        Vector6d information = Vector6d::Constant(unknown);
        information(2) = 1 / std::pow(least_m + slope_sigma * way_m, 2);
        information(3) = information(4) = 1 / std::pow(tilt_sigma_rad, 2);
        return information.asDiagonal();
    }

    void addFactors() {
        constexpr double level_sigma_rad = 0.1, unknown = 1e-6, unused = 1e3;
        constexpr double bias_sigma_rad_s = 0.05;
        auto& factors = problem_.factors;
        Vector6d level = Vector6d::Constant(unknown);
        level(3) = level(4) = 1 / std::pow(level_sigma_rad, 2);
        for (std::size_t k = 0; k < stretches_.size(); ++k) {
            const int from = static_cast<int>(k), to = from + 1;
            const Stretch& stretch = stretches_[k];
            const PlanarPose& motion = stretch.wheels.T_from_to;
            factors.push_back(std::make_shared<WheelFactor>(from, to, stretch.wheels));
            factors.push_back(std::make_shared<RelativePose>(
                from, to, lifted(motion), evenGround(std::hypot(motion.x, motion.y))));
            factors.push_back(std::make_shared<PosePrior>(
                to, problem_.states.keyframes[to].T_body_world, Matrix6d(level.asDiagonal())));
            if (!stretch.turned_rad) continue;
            const double duration_s = stretch.to_s - stretch.from_s;
            const double sigma_rad = std::hypot(
                options_.gyro_noise_rad_sqrt_s * std::sqrt(duration_s), 0.01 * *stretch.turned_rad);
            factors.push_back(std::make_shared<HeadingIncrement>(from, to, *stretch.turned_rad,
                                                                 duration_s, sigma_rad, 0));
        }
        Vector9d sigma = Vector9d::Constant(unused);
        sigma.segment<3>(3).setConstant(bias_sigma_rad_s);
        factors.push_back(std::make_shared<MotionStatePrior>(0, MotionState(), sigma));
    }

    void minimize(double outlier_sigmas) {
        constexpr int iterations = 50;
        const std::size_t others = problem_.factors.size();
        const RobustKernel kernel{KernelShape::Cauchy, outlier_sigmas * outlier_sigmas};
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            if (nodes_[k].held_out) continue;
            problem_.factors.push_back(std::make_shared<PositionMeasurement>(
                static_cast<int>(k), nodes_[k].enu, nodes_[k].sigma_m, input_.lever_arm, kernel));
        }
        adjustBundleSparse(problem_, iterations, false);
        problem_.factors.resize(others);
    }

    SE3 poseOf(std::size_t k) const { return problem_.states.keyframes[k].T_body_world.inverse(); }

    void describe(GpsFusionResult& result) const {
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            result.keyframes.push_back({nodes_[k].stamp_s, poseOf(k)});
        }
        for (std::size_t k = 0; k < stretches_.size(); ++k) {
            const SE3 T_from_to = lifted(stretches_[k].wheels.T_from_to);
            Matrix6d information = evenGround(T_from_to.t.norm());
            const Eigen::Matrix3d planar = stretches_[k].wheels.covariance.inverse();
            const int rows[] = {0, 1, 5};
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) information(rows[i], rows[j]) += planar(i, j);
            }
            result.edges.push_back({static_cast<int>(k), static_cast<int>(k + 1), T_from_to,
                                    information, EdgeKind::Sequential, 0});
        }
        result.trajectory = atWheels(result.keyframes);
        result.used = residuals(false);
        result.held_out = residuals(true);
    }

    /** Poses at the wheels' stamps between the first and the last keyframe. */
    Trajectory atWheels(const Trajectory& keyframes) const {
        Trajectory trajectory;
        for (const WheelSample& sample : input_.wheels) {
            const auto pose = poseAt(keyframes, sample.stamp_s);
            if (pose) trajectory.push_back({sample.stamp_s, *pose});
        }
        return trajectory;
    }

    FixResiduals residuals(bool held_out) const {
        constexpr double outlier_chi2 = 11.8;  // 3 sigma of two numbers
        FixResiduals sums;
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            if (nodes_[k].held_out != held_out) continue;
            const Eigen::Vector2d off = (poseOf(k) * input_.lever_arm - nodes_[k].enu).head<2>();
            const Eigen::Vector2d sigma = nodes_[k].sigma_m.head<2>();
            const double chi2 = off.cwiseQuotient(sigma).squaredNorm();
            ++sums.fixes;
            sums.outliers += chi2 > outlier_chi2;
            sums.horizontal_rms_m += off.squaredNorm();
            sums.whitened_rms += chi2 / 2;
            sums.robust_cost += cauchy(chi2, outlier_chi2).cost;
            sums.claimed_rms_m += sigma.squaredNorm();
        }
        const auto mean = [&](double sum) {
            return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, sums.fixes)));
        };
        sums.robust_cost /= static_cast<double>(std::max<std::size_t>(1, sums.fixes));
        sums.horizontal_rms_m = mean(sums.horizontal_rms_m);
        sums.whitened_rms = mean(sums.whitened_rms);
        sums.claimed_rms_m = mean(sums.claimed_rms_m);
        return sums;
    }

    const GpsFusionInput& input_;
    const GpsOptions& options_;
    std::vector<ImuSample> imu_;  // z up
    LocalTangentPlane plane_{GeodeticPlace{}};
    std::vector<Node> nodes_;
    std::vector<Stretch> stretches_;
    std::string refused_;
    double wheel_scale_ = 1;
    BundleProblem problem_;
};

/** The input without fixes that are there to check the result. */
GpsFusionInput withoutHeldOut(const GpsFusionInput& input, int every) {
    if (every < 2) return input;
    GpsFusionInput rest = input;
    rest.fixes.clear();
    for (std::size_t i = 0; i < input.fixes.size(); ++i) {
        if (i % every != static_cast<std::size_t>(every - 1)) rest.fixes.push_back(input.fixes[i]);
    }
    return rest;
}

/** How far wheels can be trusted depends on ground and robot: the value with which the other fixes
 *  predict every fourth one best. */
double bestSlipShare(const GpsFusionInput& input, GpsOptions options) {
    double best = 0, least_cost = std::numeric_limits<double>::infinity();
    options.hold_out_every = 4;
    for (const double share : {0.01, 0.02, 0.05, 0.1, 0.2, 0.4}) {
        options.wheel_slip_share = share;
        const double cost = Fusion(input, options).solve().held_out.robust_cost;
        if (cost >= least_cost) continue;
        least_cost = cost;
        best = share;
    }
    return best;
}

}  // namespace

GpsFusionResult fuseGps(const GpsFusionInput& input, const GpsOptions& options) {
    GpsOptions settled = options;
    if (settled.wheel_slip_share <= 0) {
        settled.wheel_slip_share =
            bestSlipShare(withoutHeldOut(input, options.hold_out_every), options);
    }
    GpsFusionResult result = Fusion(input, settled).solve();
    result.wheel_slip_share = settled.wheel_slip_share;
    return result;
}

}  // namespace rgbd_graphslam
