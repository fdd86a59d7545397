/** What of a MotionEstimator goes into a checkpoint. */
#include <Eigen/Cholesky>
#include <utility>

#include "motion_estimator.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

template <class Matrix>
void putMatrix(const Matrix& matrix, ByteWriter& out) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) out.put(matrix.data()[i]);
}
template <class Matrix>
Matrix getMatrix(ByteReader& in) {
    Matrix matrix;
    for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = getFinite(in);
    return matrix;
}

void putPose(const std::optional<SE3>& pose, ByteWriter& out) {
    putFlag(pose.has_value(), out);
    if (pose) encodePose(*pose, out);
}
std::optional<SE3> getPose(ByteReader& in) {
    if (!getFlag(in)) return std::nullopt;
    return decodePose(in);
}

void putBias(const ImuBias& bias, ByteWriter& out) {
    putMatrix(bias.gyro, out);
    putMatrix(bias.accelerometer, out);
}
ImuBias getBias(ByteReader& in) {
    const Eigen::Vector3d gyro = getMatrix<Eigen::Vector3d>(in);
    return {gyro, getMatrix<Eigen::Vector3d>(in)};
}

void putState(const InertialState& state, ByteWriter& out) {
    encodePose(state.body.T_body_world, out);
    putMatrix(state.body.motion.velocity, out);
    putBias({state.body.motion.gyro_bias, state.body.motion.accelerometer_bias}, out);
    putMatrix(state.gravity, out);
}
InertialState getState(ByteReader& in) {
    InertialState state;
    state.body.T_body_world = decodePose(in);
    state.body.motion.velocity = getMatrix<Eigen::Vector3d>(in);
    const ImuBias bias = getBias(in);
    state.body.motion.gyro_bias = bias.gyro;
    state.body.motion.accelerometer_bias = bias.accelerometer;
    state.gravity = getMatrix<Eigen::Vector3d>(in);
    return state;
}

void putMeasured(const std::optional<MeasuredPose>& measured, ByteWriter& out) {
    putFlag(measured.has_value(), out);
    if (!measured) return;
    encodePose(measured->T_body_world, out);
    putMatrix(measured->information, out);
}
std::optional<MeasuredPose> getMeasured(ByteReader& in) {
    if (!getFlag(in)) return std::nullopt;
    const SE3 pose = decodePose(in);
    const auto information = getMatrix<Matrix6d>(in);
    if (Eigen::LLT<Matrix6d>(information).info() != Eigen::Success) {
        throw DamagedBytes("a measured pose of no information");
    }
    return MeasuredPose{pose, information};
}

void putIncrement(const ImuIncrement& imu, ByteWriter& out) {
    out.put(imu.duration_s);
    encodePose(imu.T_from_to, out);
    putMatrix(imu.velocity, out);
    putMatrix(imu.covariance, out);
    putBias(imu.bias, out);
    putMatrix(imu.by_bias, out);
}
ImuIncrement getImuIncrement(ByteReader& in) {
    ImuIncrement imu;
    imu.duration_s = getFinite(in);
    imu.T_from_to = decodePose(in);
    imu.velocity = getMatrix<Eigen::Vector3d>(in);
    imu.covariance = getMatrix<Matrix9d>(in);
    imu.bias = getBias(in);
    imu.by_bias = getMatrix<Eigen::Matrix<double, 9, 6>>(in);
    return imu;
}

void putPlanar(const PlanarPose& pose, ByteWriter& out) {
    for (const double number : {pose.x, pose.y, pose.yaw}) out.put(number);
}
PlanarPose getPlanar(ByteReader& in) {
    PlanarPose pose;
    for (double* number : {&pose.x, &pose.y, &pose.yaw}) *number = getFinite(in);
    return pose;
}

void putSpread(const ResidualSpread& spread, ByteWriter& out) {
    out.put(spread.sum);
    out.put<std::uint64_t>(spread.count);
}
ResidualSpread getSpread(ByteReader& in) {
    const double sum = getFinite(in);
    return {sum, in.get<std::uint64_t>()};
}

void putSummary(const MotionSummary& summary, ByteWriter& out) {
    for (const std::size_t count :
         {summary.imu_readings, summary.wheel_readings, summary.wheels_compared}) {
        out.put<std::uint64_t>(count);
    }
    for (const double number :
         {summary.imu_span_s, summary.imu_gap_s, summary.wheel_span_s, summary.wheel_gap_s,
          summary.gyro_bias_sigma, summary.accelerometer_bias_sigma, summary.wheel_scale,
          summary.wheel_scale_sigma}) {
        out.put(number);
    }
    putFlag(summary.imu_used, out);
    putSpread(summary.poses, out);
    putSpread(summary.wheels, out);
    out.put<std::int32_t>(summary.restarts);
    out.putCount(summary.slips.size());
    for (const auto& [from_s, to_s] : summary.slips) {
        out.put(from_s);
        out.put(to_s);
    }
}
MotionSummary getSummary(ByteReader& in) {
    MotionSummary summary;
    for (std::size_t* count :
         {&summary.imu_readings, &summary.wheel_readings, &summary.wheels_compared}) {
        *count = in.get<std::uint64_t>();
    }
    for (double* number :
         {&summary.imu_span_s, &summary.imu_gap_s, &summary.wheel_span_s, &summary.wheel_gap_s,
          &summary.gyro_bias_sigma, &summary.accelerometer_bias_sigma, &summary.wheel_scale,
          &summary.wheel_scale_sigma}) {
        *number = getFinite(in);
    }
    summary.imu_used = getFlag(in);
    summary.poses = getSpread(in);
    summary.wheels = getSpread(in);
    summary.restarts = getTally(in);
    summary.slips.resize(in.getCount(2 * sizeof(double)));
    for (auto& [from_s, to_s] : summary.slips) {
        from_s = getFinite(in);
        to_s = getFinite(in);
    }
    return summary;
}

}  // namespace

void MotionEstimator::save(ByteWriter& out) const {
    out.putCount(imu_.size());
    for (const ImuSample& sample : imu_) {
        out.put(sample.stamp_s);
        putMatrix(sample.gyro, out);
        putMatrix(sample.accelerometer, out);
    }
    out.putCount(wheels_.size());
    for (const WheelSample& sample : wheels_) {
        out.put(sample.stamp_s);
        putPlanar(sample.T_start_base, out);
    }
    for (const SE3& pose : {T_imu_cam_, T_base_cam_, T_anchor_world_, T_odometry_cam_}) {
        encodePose(pose, out);
    }
    for (const double number : {stamp_s_, last_stamp_s_, gyro_sigma_, accelerometer_sigma_,
                                gyro_noise_, accelerometer_noise_, blind_way_m_}) {
        out.put(number);
    }
    putBias(bias_, out);
    out.put<std::int32_t>(anchor_);
    out.put<std::int32_t>(contradicted_);
    putFlag(changed_, out);
    putPose(last_raw_, out);
    putPose(last_pose_, out);
    out.putCount(waiting_.size());
    for (const Waiting& frame : waiting_) {
        out.put(frame.stamp_s);
        putMeasured(frame.measured, out);
    }
    wheel_watch_.save(out);
    putSummary(summary_, out);
    saveWindow(out);
}

void MotionEstimator::saveWindow(ByteWriter& out) const {
    putFlag(window_.started(), out);
    if (!window_.started()) return;
    putState(window_.prior().mean, out);
    putMatrix(window_.prior().information, out);
    putMatrix(window_.covariance(), out);
    out.putCount(ties_.size());
    for (std::size_t n = 0; n < window_.nodes().size(); ++n) {
        const InertialWindow::Node& node = window_.nodes()[n];
        out.put(node.stamp_s);
        putState(node.state, out);
        putMeasured(node.measured, out);
        if (n == ties_.size()) break;
        putIncrement(ties_[n].imu, out);
        putMatrix(ties_[n].covariance, out);
        putFlag(ties_[n].wheels.has_value(), out);
        if (!ties_[n].wheels) continue;
        out.put(ties_[n].wheels->duration_s);
        putPlanar(ties_[n].wheels->T_from_to, out);
        putMatrix(ties_[n].wheels->covariance, out);
    }
    out.putCount(tied_);
}

void MotionEstimator::load(ByteReader& in) {
    imu_.resize(in.getCount(7 * sizeof(double)));
    for (ImuSample& sample : imu_) {
        sample.stamp_s = getFinite(in);
        sample.gyro = getMatrix<Eigen::Vector3d>(in);
        sample.accelerometer = getMatrix<Eigen::Vector3d>(in);
    }
    wheels_.resize(in.getCount(4 * sizeof(double)));
    for (WheelSample& sample : wheels_) {
        sample.stamp_s = getFinite(in);
        sample.T_start_base = getPlanar(in);
    }
    for (SE3* pose : {&T_imu_cam_, &T_base_cam_, &T_anchor_world_, &T_odometry_cam_}) {
        *pose = decodePose(in);
    }
    for (double* number : {&stamp_s_, &last_stamp_s_, &gyro_sigma_, &accelerometer_sigma_,
                           &gyro_noise_, &accelerometer_noise_, &blind_way_m_}) {
        *number = getFinite(in);
    }
    bias_ = getBias(in);
    anchor_ = in.get<std::int32_t>();
    if (anchor_ >= static_cast<int>(map_.keyframes().size())) {
        throw DamagedBytes("motion of no keyframe");
    }
    contradicted_ = getTally(in);
    changed_ = getFlag(in);
    last_raw_ = getPose(in);
    last_pose_ = getPose(in);
    waiting_.resize(in.getCount(sizeof(double) + 1));
    for (Waiting& frame : waiting_) {
        frame.stamp_s = getFinite(in);
        frame.measured = getMeasured(in);
    }
    wheel_watch_.load(in);
    summary_ = getSummary(in);
    loadWindow(in);
}

std::vector<std::shared_ptr<const Factor>> MotionEstimator::linksOf(const Tie& tie) const {
    try {
        std::vector<std::shared_ptr<const Factor>> links{factorOf(tie.imu)};
        if (!tie.wheels) return links;
        for (auto& factor : wheelFactors(*tie.wheels)) links.push_back(std::move(factor));
        return links;
    } catch (const Error&) {
        throw DamagedBytes("a motion of no certainty");
    }
}

void MotionEstimator::loadWindow(ByteReader& in) {
    window_ = InertialWindow();
    ties_.clear();
    if (!getFlag(in)) return;
    InertialWindow::Prior prior;
    prior.mean = getState(in);
    prior.information = getMatrix<Matrix18d>(in);
    const auto covariance = getMatrix<Matrix18d>(in);
    const std::size_t ties = in.getCount(sizeof(double));
    std::vector<InertialWindow::Node> nodes;
    for (std::size_t n = 0; n <= ties; ++n) {
        const double stamp_s = getFinite(in);
        const InertialState state = getState(in);
        nodes.push_back({stamp_s, state, getMeasured(in), {}});
        if (n == ties) break;
        const ImuIncrement imu = getImuIncrement(in);
        Tie tie{imu, std::nullopt, getMatrix<Matrix18d>(in)};
        if (getFlag(in)) {
            tie.wheels.emplace();
            tie.wheels->duration_s = getFinite(in);
            tie.wheels->T_from_to = getPlanar(in);
            tie.wheels->covariance = getMatrix<Eigen::Matrix3d>(in);
        }
        nodes.back().links = linksOf(tie);
        ties_.push_back(tie);
    }
    tied_ = in.get<std::uint32_t>();
    if (tied_ > ties_.size()) throw DamagedBytes("wheels of no state");
    window_ = emptyWindow();
    window_.restore(prior, std::move(nodes), covariance);
}

}  // namespace rgbd_graphslam
