/** Position, velocity and biases from the camera's poses, inertial readings and wheels. */
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/imu_factor.h"
#include "rgbd_graphslam/estimation/inertial_window.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/slam/motion_summary.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"
#include "wheel_watch.h"

namespace rgbd_graphslam {

/** Where the other sensors put a frame. */
struct PredictedPose {
    SE3 T_cam_world;
    /** Of its left perturbation, against the map. */
    Matrix6d covariance = Matrix6d::Identity();
};

/** Follows a camera that carries an inertial sensor: every fifth of a second or so a frame becomes
 * a state of an InertialWindow, tied to the one before by preintegrated readings and the wheels,
 * and to the map by the pose that landmarks give it. The map itself does not feel it: a room seen
 * by a depth camera is known better than any IMU could tell, and what the IMU adds there would only
 * be its own errors (doc/lab/inertial.md). Begins half a second after the camera does, and again
 * after a gap in the readings; the biases are kept. */
class MotionEstimator {
  public:
    /** Both arguments must outlive it. */
    MotionEstimator(const MotionOptions& options, const SlamMap& map)
        : options_(options), map_(map) {}

    /** Takes the readings of the next frame, and tells where they put it: its reckoning then is of
     *  all sensors. */
    void note(Frame& frame);

    /** Of the frame noted last; nothing while too little is known. */
    const std::optional<PredictedPose>& predicted() const { return predicted_; }

    /** Landmarks locate the frame noted last.
     *  \param covariance of the left perturbation of T_cam_world, against the map
     *  \param reference_keyframe that it moves with */
    void located(const SE3& T_cam_world, const Matrix6d& covariance, int reference_keyframe);
    /** They do not. */
    void unlocated();
    /** The frame noted last begins a world of its own. */
    void forgetPose();

    /** Poses that a stretch without vision turns out to have had, now that its end is known: from
     *  the last frame before it to the first after it. Empty when there is nothing new. */
    std::vector<std::pair<double, SE3>> takeRevised() { return std::exchange(revised_, {}); }

    const MotionSummary& summary() const { return summary_; }

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** The map must be loaded. \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    /** A frame that waits for the readings after it. */
    struct Waiting {
        double stamp_s = 0;
        std::optional<MeasuredPose> measured;
    };
    /** How one state is tied to the next. */
    struct Tie {
        ImuIncrement imu;
        std::optional<WheelIncrement> wheels;
        /** Of the first state when it was the newest. */
        Matrix18d covariance;
    };

    void take(MotionReadings& readings);
    void moveWithMap();
    void settle();
    void begin();
    InertialState firstState(const std::vector<Waiting>& frames,
                             const std::vector<ImuSample>& readings) const;
    InertialWindow emptyWindow() const;
    void openWindow(const Waiting& frame, const InertialState& state);
    bool addFirst(const std::vector<Waiting>& frames);
    bool plausible() const;
    void addNode(const Waiting& frame);
    bool agrees(const MeasuredPose& measured, const InertialState& next,
                const Matrix18d& covariance);
    void finishNode(bool was_blind);
    void tieWheels();
    void tieWheels(std::size_t node);
    std::vector<std::shared_ptr<const Factor>> wheelFactors(const WheelIncrement& wheels) const;
    Eigen::Matrix3d uncertaintyOfWheels(std::size_t node, const WheelIncrement& increment) const;
    void noteSlip(double from_s, double to_s);
    void tellRevised();
    void reset();
    void forgetOldReadings();
    std::vector<ImuSample> readingsBetween(double from_s, double to_s) const;
    std::optional<ImuIncrement> increment(double from_s, double to_s) const;
    std::shared_ptr<ImuFactor> factorOf(const ImuIncrement& increment) const;
    ImuNoise noise() const;
    void measureNoise();
    bool blind() const;
    std::optional<std::pair<InertialState, Matrix18d>> carriedTo(double stamp_s) const;
    void predict(Frame& frame);
    void chain(Frame& frame);
    void summarize();
    /** \throws DamagedBytes when a covariance is none */
    std::vector<std::shared_ptr<const Factor>> linksOf(const Tie& tie) const;
    void saveWindow(ByteWriter& out) const;
    void loadWindow(ByteReader& in);

    const MotionOptions& options_;
    const SlamMap& map_;

    std::vector<ImuSample> imu_;
    std::vector<WheelSample> wheels_;
    SE3 T_imu_cam_, T_base_cam_;
    double stamp_s_ = 0, last_stamp_s_ = 0;  // of the frame at hand and of the one before

    std::vector<Waiting> waiting_;  // before it begins: what it begins with
    InertialWindow window_;
    std::vector<Tie> ties_;  // one per node, to the next
    std::size_t tied_ = 0;   // nodes before have been compared with the wheels
    int contradicted_ = 0;
    /** Since the last prediction. */
    bool changed_ = false;
    WheelWatch wheel_watch_;
    double blind_way_m_ = 0;

    /** Biases as far as they are known. */
    ImuBias bias_;
    double gyro_sigma_ = 0.03, accelerometer_sigma_ = 0.3;
    double gyro_noise_ = 0, accelerometer_noise_ = 0;

    /** Keyframe that the window moves with, and where it was. */
    int anchor_ = -1;
    SE3 T_anchor_world_;

    SE3 T_odometry_cam_;
    std::optional<SE3> last_raw_;
    std::optional<SE3> last_pose_;  // T_cam_world by the sensors at the frame before
    std::optional<PredictedPose> predicted_;
    std::vector<std::pair<double, SE3>> revised_;
    MotionSummary summary_;
};

}  // namespace rgbd_graphslam
