#include "motion_prior.h"

#include <algorithm>
#include <vector>

#include "rgbd_graphslam/slam/dense_odometry.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Growth of the standard deviations: as a share of the motion, per measured step, per second
 *  without any measurement (somebody walks on). */
constexpr double least_wheel_error = 0.03, image_error = 0.03;
constexpr PoseSpread image_step{0.003, 0.003};
constexpr PoseSpread unknown_speed{1.0, 1.5};
/** Of hands, per second squared, and how long the last speed tells anything. */
constexpr PoseSpread acceleration{20, 60};
constexpr double longest_inertia_s = 0.2;
/** Spread of the map itself around the place where tracking lost it. */
constexpr PoseSpread located{0.01, 0.01};

/** A pose within this and `confirming_sigmas` is confirmed, beyond this and `ruling_out_sigmas` it
 *  is contradicted. */
constexpr PoseSpread confirming{0.04, 0.04}, ruling_out{0.15, 0.12};
constexpr double confirming_sigmas = 2.5, ruling_out_sigmas = 4;

/** Wheels that disagree more with what the map has seen do not count. */
constexpr double worst_wheel_error = 0.3;
/** Way over which wheels and map are compared, and what a radian of turning counts as. */
constexpr double comparison_m = 0.5, lever_m = 0.5;
constexpr double forgetting = 0.3;

/** Least difference, and share of the motion, by which sensors rule out what images say. */
constexpr PoseSpread slack{0.03, 0.03};
constexpr double slack_share = 0.3;

/** Up to this median depth lengths are those of rooms. */
constexpr double room_depth_m = 4;

}  // namespace

double sceneScale(const Frame& frame) {
    std::vector<float> depths;
    for (const Keypoint& k : frame.keypoints) {
        if (k.depth_m > 0) depths.push_back(k.depth_m);
    }
    if (depths.empty()) return 1;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return std::max(1.0, *middle / room_depth_m);
}

void MotionPrior::restart(const Frame& frame, const std::optional<SE3>& T_last_cam) {
    if (located_ && T_last_cam) {
        compareWheels(frame, *T_last_cam);
    } else {
        seen_ = rolled_ = SE3();
        compared_m_ = 0;
    }
    scale_ = sceneScale(frame);
    spread_ = {scale_ * located.m, located.rad};
    measured_ = located_ = true;
    velocity_known_ = T_last_cam.has_value();
    remember(frame);
}

void MotionPrior::advance(const Frame& frame, const SE3& T_last_cam, Source source) {
    const double way_m = T_last_cam.t.norm(), turn_rad = T_last_cam.angle();
    const double passed_s = std::max(0.0, frame.stamp_s - last_stamp_s_);
    if (source != Source::InertiaAlone && frame.reckoning.sigma) {
        spread_ = {scale_ * located.m + frame.reckoning.sigma->x(),
                   located.rad + frame.reckoning.sigma->y()};
    } else if (source != Source::InertiaAlone && wheelsTell(frame)) {
        const double error = std::max(least_wheel_error, wheel_error_);
        spread_.m += (error + spread_.rad) * way_m;
        spread_.rad += error * turn_rad;
    } else if (source == Source::Images) {
        spread_.m += scale_ * image_step.m + (image_error + spread_.rad) * way_m;
        spread_.rad += image_step.rad + image_error * turn_rad;
    } else if (source != Source::None && !velocity_known_) {
        spread_ = anywhere;
    } else if (source != Source::None && passed_s < longest_inertia_s) {
        spread_.m += 0.5 * scale_ * acceleration.m * passed_s * passed_s;
        spread_.rad += 0.5 * acceleration.rad * passed_s * passed_s;
    } else {
        if (source == Source::None) measured_ = false;
        spread_.m += scale_ * unknown_speed.m * passed_s;
        spread_.rad += unknown_speed.rad * passed_s;
    }
    located_ = false;
    velocity_known_ |= source == Source::Images;
    remember(frame);
}

Agreement MotionPrior::judge(const SE3& T_predicted_cam) const {
    const PoseSpread off{T_predicted_cam.t.norm(), T_predicted_cam.angle()};
    if (off.m > scale_ * ruling_out.m + ruling_out_sigmas * spread_.m ||
        off.rad > ruling_out.rad + ruling_out_sigmas * spread_.rad) {
        return Agreement::Contradicted;
    }
    const bool near = off.m <= scale_ * confirming.m + confirming_sigmas * spread_.m &&
                      off.rad <= confirming.rad + confirming_sigmas * spread_.rad;
    return measured_ && near ? Agreement::Confirmed : Agreement::Possible;
}

bool MotionPrior::wheelsTell(const Frame& frame) const {
    return wheel_error_ < worst_wheel_error && rolled(frame);
}

std::optional<SE3> MotionPrior::rolled(const Frame& frame) const {
    return wheelMotion(last_, frame.reckoning, frame.stamp_s - last_stamp_s_);
}

bool MotionPrior::rulesOut(const Frame& frame, const SE3& T_last_cam) const {
    const auto differs = [](double difference, double least, double size) {
        return difference > least + slack_share * size;
    };
    const DeadReckoning& now = frame.reckoning;
    if (wheelsTell(frame)) {
        const SE3 by_wheels = *rolled(frame), difference = by_wheels.inverse() * T_last_cam;
        return differs(difference.t.norm(), scale_ * slack.m, by_wheels.t.norm()) ||
               differs(difference.angle(), slack.rad, by_wheels.angle());
    }
    if (!last_.R_gyroscope_cam || !now.R_gyroscope_cam) return false;
    const Eigen::Matrix3d turned = last_.R_gyroscope_cam->transpose() * *now.R_gyroscope_cam;
    return differs(rotationLog(turned.transpose() * T_last_cam.R).norm(), slack.rad,
                   rotationLog(turned).norm());
}

/** Both are composed over some way, so that noise of single frames does not count. */
void MotionPrior::compareWheels(const Frame& frame, const SE3& T_last_cam) {
    const auto by_wheels = rolled(frame);
    if (!by_wheels) return;
    seen_ = seen_ * T_last_cam;
    rolled_ = rolled_ * *by_wheels;
    const auto amount = [](const SE3& motion) {
        return motion.t.norm() + lever_m * motion.angle();
    };
    compared_m_ += std::max(amount(T_last_cam), amount(*by_wheels));
    if (compared_m_ < comparison_m) return;
    const double error = std::min(1.0, amount(rolled_.inverse() * seen_) / compared_m_);
    wheel_error_ += forgetting * (error - wheel_error_);
    seen_ = rolled_ = SE3();
    compared_m_ = 0;
}

void MotionPrior::remember(const Frame& frame) {
    last_ = frame.reckoning;
    last_stamp_s_ = frame.stamp_s;
}

void MotionPrior::save(ByteWriter& out) const {
    for (const double number :
         {spread_.m, spread_.rad, last_stamp_s_, wheel_error_, compared_m_, scale_}) {
        out.put(number);
    }
    for (const bool flag : {measured_, located_, velocity_known_}) putFlag(flag, out);
    put(last_, out);
    encodePose(seen_, out);
    encodePose(rolled_, out);
}

void MotionPrior::load(ByteReader& in) {
    for (double* number :
         {&spread_.m, &spread_.rad, &last_stamp_s_, &wheel_error_, &compared_m_, &scale_}) {
        *number = getFinite(in);
    }
    for (bool* flag : {&measured_, &located_, &velocity_known_}) *flag = getFlag(in);
    last_ = getReckoning(in);
    seen_ = decodePose(in);
    rolled_ = decodePose(in);
}

}  // namespace rgbd_graphslam
