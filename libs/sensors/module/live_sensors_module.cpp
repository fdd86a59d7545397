/** What rgbd-slam loads for --live. */
#include "rgbd_graphslam/sensors/live_sensors.h"

/** Starts the sensors of an ini file; they stop with `sensors`.
 *  \throws Error as readSensorFile() and LiveSensors() */
extern "C" void rgbdStartLiveSensors(const std::string& ini,
                                     const std::shared_ptr<rgbd_graphslam::LiveSource>& source,
                                     std::shared_ptr<void>& sensors) {
    using namespace rgbd_graphslam;
    sensors = std::make_shared<LiveSensors>(readSensorFile(ini), source);
}
