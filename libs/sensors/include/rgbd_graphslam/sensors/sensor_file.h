/** Ini files that describe sensors, as MRPT's rawlog-grabber reads them. */
#pragma once
#include <mrpt/config/CConfigFileMemory.h>

#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A sensor's section. */
struct SensorSection {
    std::string name;
    /** MRPT class that reads it. */
    std::string driver;
    double process_rate_hz = 0;
};

/** All sections but `[global]` and those with `rawlog-grabber-ignore = true` are sensors. Their
 *  driver reads them itself. */
struct SensorFile {
    std::string path;
    std::vector<SensorSection> sensors;
    /** Pause between starting one sensor and the next, ms. */
    int time_between_launches_ms = 300;
    /** The file's text for the drivers. */
    mrpt::config::CConfigFileMemory config;
};

/** \throws Error naming file, line or section, and key, when it cannot be read, has no sensor, or a
 *          sensor has no driver or no usable process_rate */
SensorFile readSensorFile(const std::string& path);

/** As the above. \param path stands for the file in error messages */
SensorFile parseSensorFile(const std::string& text, const std::string& path);

}  // namespace rgbd_graphslam
