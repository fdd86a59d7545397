/** Sensors that are read while the program runs. */
#pragma once
#include <memory>

#include "rgbd_graphslam/input/live_source.h"
#include "rgbd_graphslam/sensors/sensor_file.h"

namespace rgbd_graphslam {

/** Reads each sensor of a file in a thread of its own and hands what it sends to a LiveSource,
 *  while it lives. A sensor that fails later is reported and started again every second until it
 *  runs. Sensors that are silent are reported. When all are replays that have ended, the source is
 *  closed. */
class LiveSensors {
  public:
    /** Starts the sensors one after the other.
     *  \throws Error naming file, section and reason when one is unknown, refuses its settings or
     *          cannot be started */
    LiveSensors(const SensorFile& file, std::shared_ptr<LiveSource> source);
    /** Stops them. */
    ~LiveSensors();
    LiveSensors(const LiveSensors&) = delete;
    LiveSensors& operator=(const LiveSensors&) = delete;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
