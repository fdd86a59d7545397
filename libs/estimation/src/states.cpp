#include "rgbd_graphslam/estimation/states.h"

namespace rgbd_graphslam {

MotionState MotionState::retract(const Vector9d& delta) const {
    return {velocity + delta.head<3>(), gyro_bias + delta.segment<3>(3),
            accelerometer_bias + delta.tail<3>()};
}

Vector9d MotionState::minus(const MotionState& other) const {
    Vector9d delta;
    delta << velocity - other.velocity, gyro_bias - other.gyro_bias,
        accelerometer_bias - other.accelerometer_bias;
    return delta;
}

KeyframeState KeyframeState::retract(const Vector6d& delta) const {
    return {T_body_world.retract(delta), motion};
}

KeyframeState KeyframeState::retract(const Vector15d& delta) const {
    return {T_body_world.retract(delta.head<6>()), motion.retract(delta.tail<9>())};
}

Vector15d KeyframeState::minus(const KeyframeState& other) const {
    Vector15d delta;
    delta << T_body_world.minus(other.T_body_world), motion.minus(other.motion);
    return delta;
}

}  // namespace rgbd_graphslam
