/** Compares gyroscope and odometry with what the camera has tracked. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <optional>
#include <string>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/dataset/odometry_check.h"
#include "rgbd_graphslam/dataset/sensor_remedy.h"
#include "rgbd_graphslam/slam/visual_slam.h"
#include "thinned_readings.h"

namespace rgbd_graphslam {

/** Takes entries and frames in the order of the rawlog. Sensors are compared after 60 frames, 90,
 *  135, ... and at the end. One that contradicts the tracked frames is told of once and takes no
 *  part in bridging frames without vision from then on, unless more frames clear it. Which sensors
 *  are left out is the only state that reading over the rawlog does not bring back. */
class SensorWatch {
  public:
    explicit SensorWatch(const mrpt::obs::CObservation3DRangeScan& first_frame);

    /** Of each kind, the sensor that comes first is watched. */
    void note(const mrpt::obs::CObservation& observation);

    /** Takes away what sensors say that are left out. */
    void withhold(Frame& frame) const;

    /** Compares when it is time. \param frames how many were tracked so far */
    void compareWhenDue(const VisualSlam& slam, std::size_t frames);

    /** Compares with the final trajectory, and the camera's way with the accelerometer's;
     *  tells of sensors that end before the frames do. */
    void conclude(const VisualSlam& slam);

    /** Of the gyroscope's stamps, by the last comparison. */
    const std::optional<StampDelay>& gyroscopeDelay() const { return gyroscope_delay_; }

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    struct Sensor {
        std::optional<std::string> label;
        SE3 T_base_sensor;
        ThinnedReadings readings;
        bool left_out = false, told = false;
    };
    static bool watched(Sensor& sensor, const mrpt::obs::CObservation& observation);
    void compare(const VisualSlam& slam);
    void compareGyroscope(const TrackedStretches& camera);
    void compareOdometry(const TrackedStretches& camera);
    void tellOfEnds(const VisualSlam& slam) const;
    void compareScale(const TrackedStretches& camera) const;
    void take(const SensorVerdict& verdict, const std::string& kind, const std::string& remedy,
              Sensor& sensor) const;

    SE3 T_base_camera_sensor_, T_base_cam_;
    double depth_units_;
    /** Frames that may have followed a sensor that is found wrong only at the end. */
    std::ptrdiff_t bridged_frames_ = 0;
    Sensor gyroscope_, accelerometer_, odometry_;
    std::optional<StampDelay> gyroscope_delay_;
};

}  // namespace rgbd_graphslam
