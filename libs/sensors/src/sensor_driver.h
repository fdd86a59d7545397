/** One of MRPT's drivers, with its traps. */
#pragma once
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <string>
#include <vector>

#include "rgbd_graphslam/sensors/sensor_file.h"

namespace rgbd_graphslam {

/** Creates a sensor and reads it. One that has failed is never destroyed: destructors of MRPT's
 *  drivers throw then (COpenNI2Sensor without a device), which would end the program. */
class SensorDriver {
  public:
    /** \throws Error naming file, section and what is wrong with the driver or its settings */
    SensorDriver(const SensorFile& file, const SensorSection& section);
    ~SensorDriver();
    SensorDriver(const SensorDriver&) = delete;
    SensorDriver& operator=(const SensorDriver&) = delete;

    /** \throws Error in one line */
    void start();
    /** \return what came. \throws Error in one line */
    std::vector<mrpt::obs::CObservation::Ptr> read();
    /** Whether it will never send anything more. */
    bool ended() const;

  private:
    mrpt::hwdrivers::CGenericSensor::Ptr sensor_;
    bool works_ = false;
};

}  // namespace rgbd_graphslam
