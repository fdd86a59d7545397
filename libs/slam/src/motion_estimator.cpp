#include "motion_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/estimation/factor_evaluation.h"
#include "rgbd_graphslam/estimation/rolling_factor.h"
#include "rgbd_graphslam/estimation/wheel_factor.h"

namespace rgbd_graphslam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** Time between states, and how many are kept once the map has confirmed the newest. */
constexpr double interval_s = 0.18;
constexpr std::size_t kept_nodes = 8;
/** Of the way of a robot's base along its own z axis: suspension, and per way, pitching. */
constexpr double rolling_m = 0.003, rolling_share = 0.02, rolling_limit = 9;
/** Longer blind stretches are not estimated again as a whole. */
constexpr std::size_t most_blind_nodes = 150;
/** What it begins with. */
constexpr double start_span_s = 0.5;
constexpr double longest_gap_s = 0.1;
/** A frame is a little later than the last reading before it. */
constexpr double latest_reading_s = 0.03;
/** What all poses of a place err alike comes on top of what the frame itself errs. */
constexpr double common_m = 0.002, common_rad = 0.001;
constexpr double gravity_walk = 0.003;
/** Of squared distances, six degrees of freedom: beyond, a pose by landmarks is doubted, and as
 *  often in a row as this the estimate. */
constexpr double pose_limit = 60;
constexpr int most_contradicted = 5;
/** A start that fits worse is none: units or axes are wrong. */
constexpr double worst_start = 12;
constexpr double largest_gyro_bias = 0.3, largest_accelerometer_bias = 2.5;
/** Readings that tell the noise. */
constexpr std::size_t noise_readings = 60;
/** Of the noise, for all that is not white: scale errors, misalignment, vibration. */
constexpr double noise_margin = 1.3;
/** Standard deviation of the position beyond which it tells nothing. */
constexpr double lost_m = 1.5;

Matrix6d information(const Matrix6d& covariance) {
    Matrix6d sum = covariance;
    sum.diagonal().head<3>().array() += common_m * common_m;
    sum.diagonal().tail<3>().array() += common_rad * common_rad;
    return sum.inverse();
}

/** Standard deviation of white noise in readings of a smooth signal, by their second differences.
 */
double whiteNoise(std::vector<double> second_differences) {
    const auto middle =
        second_differences.begin() + static_cast<std::ptrdiff_t>(second_differences.size() / 2);
    std::nth_element(second_differences.begin(), middle, second_differences.end());
    return *middle / 0.6745 / std::sqrt(6.0);
}

PlanarPose planar(const SE3& motion) {
    return {motion.t.x(), motion.t.y(), std::atan2(motion.R(1, 0), motion.R(0, 0))};
}

template <class Sample>
void addRising(const std::vector<Sample>& more, std::vector<Sample>& samples) {
    for (const Sample& sample : more) {
        if (samples.empty() || sample.stamp_s > samples.back().stamp_s) samples.push_back(sample);
    }
}

template <class Sample>
void dropBefore(double stamp_s, std::vector<Sample>& samples) {
    auto first = samples.begin();
    while (samples.end() - first > 2 && (first + 1)->stamp_s <= stamp_s) ++first;
    samples.erase(samples.begin(), first);
}

template <class Sample>
void measureRate(const std::vector<Sample>& more, double last_s, std::size_t& count, double& span_s,
                 double& gap_s) {
    for (const Sample& sample : more) {
        if (count > 0) {
            span_s += sample.stamp_s - last_s;
            gap_s = std::max(gap_s, sample.stamp_s - last_s);
        }
        last_s = sample.stamp_s;
        ++count;
    }
}

}  // namespace

ImuNoise MotionEstimator::noise() const {
    return {gyro_noise_, accelerometer_noise_, options_.gyro_walk, options_.accelerometer_walk};
}

void MotionEstimator::note(Frame& frame) {
    last_stamp_s_ = std::exchange(stamp_s_, frame.stamp_s);
    take(frame.readings);
    moveWithMap();
    settle();
    predict(frame);
    chain(frame);
    forgetOldReadings();
}

void MotionEstimator::take(MotionReadings& readings) {
    if (!options_.use_imu) readings.imu.clear();
    if (!options_.use_wheels) readings.wheels.clear();
    for (ImuSample& sample : readings.imu) sample.stamp_s += options_.imu_time_offset_s;
    if (!readings.imu.empty()) T_imu_cam_ = readings.T_imu_cam;
    T_base_cam_ = readings.T_base_cam;
    measureRate(readings.imu, imu_.empty() ? 0 : imu_.back().stamp_s, summary_.imu_readings,
                summary_.imu_span_s, summary_.imu_gap_s);
    measureRate(readings.wheels, wheels_.empty() ? 0 : wheels_.back().stamp_s,
                summary_.wheel_readings, summary_.wheel_span_s, summary_.wheel_gap_s);
    addRising(readings.imu, imu_);
    addRising(readings.wheels, wheels_);
    readings = {};
}

/** Local adjustment, loops and merged submaps move the keyframes. */
void MotionEstimator::moveWithMap() {
    if (anchor_ < 0) return;
    const SE3& now = map_.T_cam_world(anchor_);
    const SE3 T_new_old = now.inverse() * T_anchor_world_;
    T_anchor_world_ = now;
    if (T_new_old.t.norm() < 1e-12 && T_new_old.angle() < 1e-12) return;
    if (window_.started()) window_.transform(T_new_old);
    const SE3 T_old_new = T_new_old.inverse();
    for (Waiting& frame : waiting_) {
        if (frame.measured) frame.measured->T_body_world = frame.measured->T_body_world * T_old_new;
    }
    if (last_pose_) last_pose_ = *last_pose_ * T_old_new;
    Matrix18d turn = Matrix18d::Identity();
    turn.block<3, 3>(6, 6) = turn.block<3, 3>(15, 15) = T_new_old.R;
    for (Tie& tie : ties_) tie.covariance = turn * tie.covariance * turn.transpose();
}

/** Takes the frames in whose readings reach beyond them. */
void MotionEstimator::settle() {
    if (!window_.started()) {
        if (!waiting_.empty() &&
            waiting_.back().stamp_s - waiting_.front().stamp_s >= start_span_s) {
            begin();
        }
        if (!window_.started()) return;
    }
    while (!waiting_.empty() && window_.started()) {
        const Waiting frame = waiting_.front();
        const bool reached = !imu_.empty() && imu_.back().stamp_s >= frame.stamp_s;
        if (!reached && stamp_s_ - frame.stamp_s < longest_gap_s) break;
        waiting_.erase(waiting_.begin());
        addNode(frame);
    }
    if (window_.started()) tieWheels();
}

void MotionEstimator::measureNoise() {
    if (gyro_noise_ > 0 || imu_.size() < noise_readings) return;
    std::vector<double> rates, forces;
    for (std::size_t i = 1; i + 1 < imu_.size(); ++i) {
        const auto bend = [&](const auto& value) {
            return Vector3d(value(imu_[i + 1]) - 2 * value(imu_[i]) + value(imu_[i - 1]));
        };
        const Vector3d rate = bend([](const ImuSample& s) { return s.gyro; });
        const Vector3d force = bend([](const ImuSample& s) { return s.accelerometer; });
        for (int axis = 0; axis < 3; ++axis) {
            rates.push_back(std::abs(rate[axis]));
            forces.push_back(std::abs(force[axis]));
        }
    }
    const double root = std::sqrt((imu_.back().stamp_s - imu_.front().stamp_s) /
                                  static_cast<double>(imu_.size() - 1));
    gyro_noise_ =
        std::max(options_.least_gyro_noise, noise_margin * root * whiteNoise(std::move(rates)));
    accelerometer_noise_ = std::max(options_.least_accelerometer_noise,
                                    noise_margin * root * whiteNoise(std::move(forces)));
}

void MotionEstimator::begin() {
    const double to_s = waiting_.back().stamp_s;
    const std::vector<ImuSample> readings = readingsBetween(waiting_.front().stamp_s, to_s);
    const bool reached = !readings.empty() && readings.back().stamp_s >= to_s;
    if (!reached && stamp_s_ - to_s < longest_gap_s) return;
    measureNoise();
    const std::vector<Waiting> first = std::exchange(waiting_, {});
    if (!reached || gyro_noise_ == 0) return;
    openWindow(first.front(), firstState(first, readings));
    if (!addFirst(first)) return reset();
    window_.optimize(8);
    if (!plausible()) return reset();
    changed_ = true;
    summary_.imu_used = true;
}

/** From poses over half a second: velocity by their differences, gravity by the mean force. */
InertialState MotionEstimator::firstState(const std::vector<Waiting>& frames,
                                          const std::vector<ImuSample>& readings) const {
    const auto worldFromImu = [&](const Waiting& frame) {
        return (T_imu_cam_ * frame.measured->T_body_world).inverse();
    };
    const Vector3d way = worldFromImu(frames.back()).t - worldFromImu(frames.front()).t;
    Vector3d force = Vector3d::Zero();
    std::size_t at = 0;
    for (const ImuSample& sample : readings) {
        while (at + 1 < frames.size() && frames[at + 1].stamp_s <= sample.stamp_s) ++at;
        force += worldFromImu(frames[at]).R * (sample.accelerometer - bias_.accelerometer);
    }
    InertialState state;
    state.body = {
        frames.front().measured->T_body_world,
        {way / (frames.back().stamp_s - frames.front().stamp_s), bias_.gyro, bias_.accelerometer}};
    state.gravity = -options_.gravity_m_s2 * force.normalized();
    return state;
}

InertialWindow MotionEstimator::emptyWindow() const {
    InertialWindow::GravityModel gravity;
    gravity.strength = options_.gravity_m_s2;
    gravity.walk = gravity_walk;
    return InertialWindow(gravity);
}

void MotionEstimator::openWindow(const Waiting& frame, const InertialState& state) {
    Vector18d sigma;
    sigma << Vector6d::Constant(0.5), Vector3d::Constant(1), Vector3d::Constant(gyro_sigma_),
        Vector3d::Constant(accelerometer_sigma_), Vector3d::Constant(3);
    window_ = emptyWindow();
    window_.start(frame.stamp_s, state, sigma);
    window_.measure(0, frame.measured);
    ties_.clear();
    tied_ = 0;
    contradicted_ = 0;
}

/** \return false after a gap in the readings */
bool MotionEstimator::addFirst(const std::vector<Waiting>& frames) {
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const InertialWindow::Node& newest = window_.nodes().back();
        const bool last = i + 1 == frames.size();
        if (!last && frames[i].stamp_s - newest.stamp_s < start_span_s / 5) continue;
        const auto moved = increment(newest.stamp_s, frames[i].stamp_s);
        if (!moved) return false;
        const InertialState next = carriedOn(newest.state, *moved, T_imu_cam_);
        ties_.push_back({*moved, std::nullopt, window_.covariance()});
        window_.add({frames[i].stamp_s, next, frames[i].measured, {}}, {factorOf(*moved)},
                    window_.covariance());
    }
    return true;
}

/** Wrong units, axes or clocks do not fit what the camera sees. */
bool MotionEstimator::plausible() const {
    double chi2 = 0;
    for (const InertialWindow::Node& node : window_.nodes()) {
        const Vector6d off = node.state.body.T_body_world.minus(node.measured->T_body_world);
        chi2 += off.dot(node.measured->information * off);
    }
    const MotionState& motion = window_.nodes().back().state.body.motion;
    return chi2 < worst_start * static_cast<double>(window_.nodes().size()) &&
           motion.gyro_bias.norm() < largest_gyro_bias &&
           motion.accelerometer_bias.norm() < largest_accelerometer_bias;
}

bool MotionEstimator::blind() const {
    return !window_.nodes().back().measured;
}

void MotionEstimator::addNode(const Waiting& frame) {
    const auto moved = increment(window_.nodes().back().stamp_s, frame.stamp_s);
    if (!moved) return reset();
    const InertialState last = window_.nodes().back().state;
    const InertialState next = carriedOn(last, *moved, T_imu_cam_);
    const auto factor = factorOf(*moved);
    const Matrix18d covariance = propagationOf(
        last, next, *factor, gravity_walk * gravity_walk * moved->duration_s)(window_.covariance());
    auto measured = frame.measured;
    if (measured && !agrees(*measured, next, covariance)) {
        measured.reset();
        if (++contradicted_ >= most_contradicted) return reset();
    } else if (measured) {
        contradicted_ = 0;
    }
    const bool was_blind = blind();
    ties_.push_back({*moved, std::nullopt, window_.covariance()});
    window_.add({frame.stamp_s, next, measured, {}}, {factor}, covariance);
    finishNode(was_blind);
}

bool MotionEstimator::agrees(const MeasuredPose& measured, const InertialState& next,
                             const Matrix18d& covariance) {
    const Vector6d off = measured.T_body_world.minus(next.body.T_body_world);
    const Matrix6d sum = covariance.topLeftCorner<6, 6>() + measured.information.inverse();
    const double chi2 = off.dot(sum.llt().solve(off));
    if (!(chi2 <= pose_limit)) return false;
    summary_.poses.add(chi2, 6);
    return true;
}

void MotionEstimator::finishNode(bool was_blind) {
    const bool sees = !blind();
    changed_ = true;
    if (sees) window_.optimize(was_blind ? 6 : 1);
    if (sees && was_blind) tellRevised();
    const std::size_t keep = sees && !was_blind ? kept_nodes : most_blind_nodes;
    const std::size_t dropped = window_.nodes().size() > keep ? window_.nodes().size() - keep : 0;
    window_.marginalize(keep);
    ties_.erase(ties_.begin(), ties_.begin() + static_cast<std::ptrdiff_t>(dropped));
    tied_ = tied_ > dropped ? tied_ - dropped : 0;
    const MotionState& motion = window_.nodes().back().state.body.motion;
    bias_ = {motion.gyro_bias, motion.accelerometer_bias};
    summarize();
}

void MotionEstimator::tellRevised() {
    const auto& nodes = window_.nodes();
    std::size_t first = nodes.size() - 1;
    while (first > 0 && !nodes[first - 1].measured) --first;
    revised_.clear();
    for (std::size_t n = first > 0 ? first - 1 : 0; n < nodes.size(); ++n) {
        revised_.emplace_back(nodes[n].stamp_s, nodes[n].state.body.T_body_world);
    }
}

/** The wheels' readings reach a state later than it is made. */
void MotionEstimator::tieWheels() {
    while (tied_ < ties_.size()) {
        const double to_s = window_.nodes()[tied_ + 1].stamp_s;
        if (wheels_.empty() || wheels_.back().stamp_s < to_s) {
            if (stamp_s_ - to_s < longest_gap_s) return;
        } else {
            tieWheels(tied_);
        }
        ++tied_;
    }
}

void MotionEstimator::tieWheels(std::size_t node) {
    const auto &from = window_.nodes()[node], &to = window_.nodes()[node + 1];
    const auto raw = preintegrate(wheels_, from.stamp_s, to.stamp_s, WheelNoise());
    if (!raw) return;
    const bool seen_both = from.measured && to.measured;
    if (seen_both) blind_way_m_ = 0;
    const WheelIncrement wheels = wheel_watch_.corrected(*raw, blind_way_m_);
    blind_way_m_ += std::hypot(wheels.T_from_to.x, wheels.T_from_to.y);
    const SE3 T_from_to = T_base_cam_ * from.state.body.T_body_world *
                          (T_base_cam_ * to.state.body.T_body_world).inverse();
    const PlanarPose seen = planar(T_from_to);
    const Vector3d residual(seen.x - wheels.T_from_to.x, seen.y - wheels.T_from_to.y,
                            std::remainder(seen.yaw - wheels.T_from_to.yaw, 2 * M_PI));
    ++summary_.wheels_compared;
    const bool slipped =
        wheel_watch_.slipped(residual, wheels.covariance + uncertaintyOfWheels(node, wheels));
    if (slipped) return noteSlip(from.stamp_s, to.stamp_s);
    summary_.wheels.add(wheel_watch_.chi2(), 3);
    if (seen_both) wheel_watch_.learn(*raw, seen, common_m);
    ties_[node].wheels = wheels;
    for (const auto& factor : wheelFactors(wheels)) window_.link(node, factor);
    changed_ = true;
    if (blind()) window_.optimize(1);
}

std::vector<std::shared_ptr<const Factor>> MotionEstimator::wheelFactors(
    const WheelIncrement& wheels) const {
    const double way = std::hypot(wheels.T_from_to.x, wheels.T_from_to.y);
    return {std::make_shared<WheelFactor>(0, 1, wheels, T_base_cam_),
            std::make_shared<RollingFactor>(0, 1, rolling_m + rolling_share * way, T_base_cam_,
                                            RobustKernel{KernelShape::Huber, rolling_limit})};
}

/** Covariance of what all but the wheels says of their increment. */
Eigen::Matrix3d MotionEstimator::uncertaintyOfWheels(std::size_t node,
                                                     const WheelIncrement& increment) const {
    const auto &from = window_.nodes()[node], &to = window_.nodes()[node + 1];
    if (from.measured && to.measured) {
        return Vector3d(common_m, common_m, common_rad).cwiseAbs2().asDiagonal();
    }
    const Propagation carried =
        propagationOf(from.state, to.state, *factorOf(ties_[node].imu),
                      gravity_walk * gravity_walk * (to.stamp_s - from.stamp_s));
    WheelIncrement unit = increment;
    unit.covariance.setIdentity();
    const WheelFactor factor(0, 1, unit, T_base_cam_);
    FactorEvaluation evaluation(factor);
    evaluation.evaluate({{from.state.body, to.state.body}, {}}, true);
    Eigen::Matrix<double, 3, 18> by_from = Eigen::Matrix<double, 3, 18>::Zero(), by_to = by_from;
    by_from.leftCols<6>() = evaluation.jacobian(0);
    by_to.leftCols<6>() = evaluation.jacobian(1);
    by_from += by_to * carried.F;
    return by_from * ties_[node].covariance * by_from.transpose() +
           by_to * carried.Q * by_to.transpose();
}

void MotionEstimator::noteSlip(double from_s, double to_s) {
    auto& slips = summary_.slips;
    if (!slips.empty() && from_s <= slips.back().second) {
        slips.back().second = to_s;
    } else {
        slips.emplace_back(from_s, to_s);
    }
}

/** Begins anew, with the biases known so far. */
void MotionEstimator::reset() {
    summary_.restarts += window_.started() && summary_.imu_used;
    window_ = InertialWindow();
    ties_.clear();
    tied_ = 0;
    waiting_.clear();
    predicted_.reset();
}

void MotionEstimator::forgetPose() {
    reset();
    anchor_ = -1;
    last_pose_.reset();
}

void MotionEstimator::forgetOldReadings() {
    double needed_s = stamp_s_ - latest_reading_s;
    if (!waiting_.empty()) needed_s = waiting_.front().stamp_s;
    if (window_.started()) {
        const std::size_t node = std::min(tied_, window_.nodes().size() - 1);
        needed_s = window_.nodes()[node].stamp_s;
    }
    dropBefore(std::min(needed_s, last_stamp_s_), imu_);
    dropBefore(std::min(needed_s, last_stamp_s_), wheels_);
}

std::vector<ImuSample> MotionEstimator::readingsBetween(double from_s, double to_s) const {
    std::vector<ImuSample> readings;
    for (std::size_t i = 0; i < imu_.size(); ++i) {
        const bool after = i + 1 == imu_.size() || imu_[i + 1].stamp_s > from_s;
        const bool before = i == 0 || imu_[i - 1].stamp_s < to_s;
        if (after && before) readings.push_back(imu_[i]);
    }
    return readings;
}

/** With the last reading kept up to a moment shortly after it. */
std::optional<ImuIncrement> MotionEstimator::increment(double from_s, double to_s) const {
    std::vector<ImuSample> readings = readingsBetween(from_s, to_s);
    if (readings.empty()) return std::nullopt;
    ImuSample held = readings.back();
    if (held.stamp_s < to_s && to_s - held.stamp_s <= latest_reading_s) {
        held.stamp_s = to_s;
        readings.push_back(held);
    }
    const MotionState& motion = window_.nodes().back().state.body.motion;
    return preintegrate(readings, from_s, to_s, {motion.gyro_bias, motion.accelerometer_bias},
                        noise(), longest_gap_s);
}

std::shared_ptr<ImuFactor> MotionEstimator::factorOf(const ImuIncrement& increment) const {
    auto factor =
        std::make_shared<ImuFactor>(0, 1, increment, Vector3d(0, 0, 0), noise(), T_imu_cam_);
    factor->estimateGravity(0);
    return factor;
}

std::optional<std::pair<InertialState, Matrix18d>> MotionEstimator::carriedTo(
    double stamp_s) const {
    if (!window_.started()) return std::nullopt;
    const InertialWindow::Node& newest = window_.nodes().back();
    if (stamp_s <= newest.stamp_s) return {{newest.state, window_.covariance()}};
    const auto moved = increment(newest.stamp_s, stamp_s);
    if (!moved) return std::nullopt;
    const InertialState next = carriedOn(newest.state, *moved, T_imu_cam_);
    const auto carried = propagationOf(newest.state, next, *factorOf(*moved),
                                       gravity_walk * gravity_walk * moved->duration_s);
    return {{next, carried(window_.covariance())}};
}

void MotionEstimator::predict(Frame& frame) {
    predicted_.reset();
    if (const auto carried = carriedTo(frame.stamp_s)) {
        predicted_ =
            PredictedPose{carried->first.body.T_body_world, carried->second.topLeftCorner<6, 6>()};
        if (std::exchange(changed_, false)) {
            if (const auto before = carriedTo(last_stamp_s_)) {
                last_pose_ = before->first.body.T_body_world;
            }
        }
    } else if (window_.started()) {
        reset();
    }
    const auto variance = [&] { return predicted_->covariance.topLeftCorner<3, 3>().trace(); };
    if (predicted_ && !(variance() < lost_m * lost_m)) reset();
    if (contradicted_ > 0) predicted_.reset();
}

/** What the frame's reckoning tells is one way without leaps, whichever sensors tell it. */
void MotionEstimator::chain(Frame& frame) {
    auto& told = frame.reckoning.T_odometry_cam;
    const std::optional<SE3> raw = told;
    if (predicted_ && last_pose_) {
        T_odometry_cam_ = T_odometry_cam_ * (*last_pose_ * predicted_->T_cam_world.inverse());
        T_odometry_cam_.R = orthonormalized(T_odometry_cam_.R);
        told = T_odometry_cam_;
        const auto sigma = [&](int first) {
            return std::sqrt(predicted_->covariance.block<3, 3>(first, first).trace());
        };
        frame.reckoning.sigma = Eigen::Vector2d(sigma(0), sigma(3));
    } else if (raw && last_raw_) {
        T_odometry_cam_ = T_odometry_cam_ * (last_raw_->inverse() * *raw);
        told = T_odometry_cam_;
    } else if (raw) {
        told = T_odometry_cam_;
    }
    last_raw_ = raw;
    last_pose_ = predicted_ ? std::optional<SE3>(predicted_->T_cam_world) : std::nullopt;
}

void MotionEstimator::located(const SE3& T_cam_world, const Matrix6d& covariance,
                              int reference_keyframe) {
    anchor_ = reference_keyframe;
    T_anchor_world_ = map_.T_cam_world(reference_keyframe);
    const MeasuredPose measured{T_cam_world, information(covariance)};
    if (imu_.empty()) return waiting_.clear();
    const bool begins = !window_.started();
    if (!begins) {
        const bool was_blind = blind();
        const double last_s =
            waiting_.empty() ? window_.nodes().back().stamp_s : waiting_.back().stamp_s;
        if (stamp_s_ - last_s < interval_s && !was_blind) return;
    }
    waiting_.push_back({stamp_s_, measured});
}

void MotionEstimator::unlocated() {
    if (!window_.started()) return waiting_.clear();
    const double last_s =
        waiting_.empty() ? window_.nodes().back().stamp_s : waiting_.back().stamp_s;
    if (stamp_s_ - last_s >= interval_s) waiting_.push_back({stamp_s_, std::nullopt});
}

void MotionEstimator::summarize() {
    summary_.bias = bias_;
    const auto& variance = window_.covariance().diagonal();
    gyro_sigma_ = std::sqrt(variance.segment<3>(9).mean());
    accelerometer_sigma_ = std::sqrt(variance.segment<3>(12).mean());
    summary_.gyro_bias_sigma = gyro_sigma_;
    summary_.accelerometer_bias_sigma = accelerometer_sigma_;
    summary_.gyro_noise = gyro_noise_;
    summary_.accelerometer_noise = accelerometer_noise_;
    summary_.wheel_scale = wheel_watch_.scale();
    summary_.wheel_scale_sigma = wheel_watch_.scaleSigma();
}

}  // namespace rgbd_graphslam
