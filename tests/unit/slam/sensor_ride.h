/** A camera, an IMU and wheels along a scenario, without any picture. */
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "../../../libs/slam/src/motion_estimator.h"
#include "rgbd_graphslam/synth/robot_sensors.h"
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam {

/** Feeds a MotionEstimator with what the sensors of a scenario read, at 30 frames per second, and
 *  with poses as landmarks give them: 2 mm and 1 mrad off, of which half is common to the frames of
 *  a second or so. The frames' reckoning is left to the estimator. */
class SensorRide {
  public:
    SensorRide(const std::string& scenario, std::uint64_t seed, int session = 1)
        : world_(synth::findScenario(scenario).build(session, seed)),
          imu_(world_.motion, world_.inertial, seed),
          wheels_(world_.motion, world_.wheels, seed, world_.slips),
          random_(synth::Random::of(seed, 99)),
          map_(1.2, 8),
          estimator_(options_, map_) {
        map_.addKeyframe(Frame(), SE3());
    }

    /** \param blind landmarks do not locate the frame */
    void next(bool blind = false) {
        const double t = frames_++ / 30.0;
        Frame frame;
        frame.stamp_s = 1000 + t;
        if (has_imu) readImu(t, frame);
        if (world_.motion.T_world_base) readWheels(t, frame);
        estimator_.note(frame);
        reckoning = frame.reckoning;
        if (blind) return estimator_.unlocated();
        const SE3 seen = truth().retract(seenError());
        Matrix6d covariance = Matrix6d::Zero();
        covariance.diagonal() << Eigen::Vector3d::Constant(2.25e-6),
            Eigen::Vector3d::Constant(5e-7);
        estimator_.located(seen, covariance, 0);
    }
    void drive(double seconds, bool blind = false) {
        for (int i = 0; i < std::lround(30 * seconds); ++i) next(blind);
    }

    double time() const { return (frames_ - 1) / 30.0; }
    /** T_cam_world of the last frame. */
    SE3 truth() const { return T_cam_world(time()); }
    SE3 T_cam_world(double t) const { return world_.motion.T_world_cam(t).inverse(); }
    /** Left perturbation of the pose that the estimator predicted for the last frame, by the truth:
     *  the error in the camera's frame. */
    Vector6d error() const { return estimator_.predicted()->T_cam_world.minus(truth()); }
    const MotionEstimator& estimator() const { return estimator_; }
    MotionEstimator& estimator() { return estimator_; }
    /** Errors of force, then rate. */
    const Vector6d& bias() const { return imu_.bias(); }
    const synth::World& world() const { return world_; }
    SlamMap& map() { return map_; }

    bool has_imu = true;
    double rate_unit = 1;  // per rad/s
    DeadReckoning reckoning;
    MotionOptions options_;

  private:
    void readImu(double t, Frame& frame) {
        for (; readings_ / 200.0 - 0.1 <= t; ++readings_) {
            const double at = readings_ / 200.0 - 0.1;
            const auto reading = imu_.read(at, readings_);
            frame.readings.imu.push_back(
                {1000 + at, rate_unit * reading.angular_rate, reading.specific_force});
        }
    }
    void readWheels(double t, Frame& frame) {
        frame.readings.T_base_cam = synth::robotCamera();
        for (; turns_ / 20.0 - 0.1 <= t; ++turns_) {
            const double at = turns_ / 20.0 - 0.1;
            const Eigen::Vector3d pose = wheels_.advance(at);
            frame.readings.wheels.push_back({1000 + at, {pose.x(), pose.y(), pose.z()}});
        }
    }
    Vector6d seenError() {
        Vector6d error;
        const double keep = std::exp(-1 / 30.0);
        for (int i = 0; i < 6; ++i) {
            const double sigma = i < 3 ? 0.0014 : 0.0007;
            common_[i] = keep * common_[i] + std::sqrt(1 - keep * keep) * sigma * random_.normal();
            error[i] = common_[i] + sigma * random_.normal();
        }
        return error;
    }

    synth::World world_;
    synth::InertialUnit imu_;
    synth::Odometer wheels_;
    synth::Random random_;
    SlamMap map_;
    MotionEstimator estimator_;
    Vector6d common_ = Vector6d::Zero();
    int frames_ = 0, readings_ = 0, turns_ = 0;
};

}  // namespace rgbd_graphslam
