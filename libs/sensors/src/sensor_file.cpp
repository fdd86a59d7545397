#include "rgbd_graphslam/sensors/sensor_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/ini_formulas.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* global = "global";

std::string stripped(const std::string& text) {
    const auto from = text.find_first_not_of(" \t\r");
    if (from == std::string::npos) return "";
    return text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

bool isComment(const std::string& line) {
    return line.empty() || line[0] == ';' || line[0] == '#' || line.rfind("//", 0) == 0;
}

[[noreturn]] void refuse(const std::string& path, int line, const std::string& problem,
                         const std::string& remedy) {
    throw Error(path + ":" + std::to_string(line) + ": " + problem, remedy);
}

/** Refuses what MRPT would pass over without a word. \return the sections in their order */
std::vector<std::string> sectionsOf(const std::string& text, const std::string& path) {
    std::istringstream in(text);
    std::vector<std::string> sections;
    std::string line;
    bool continued = false;
    for (int number = 1; std::getline(in, line); ++number) {
        line = stripped(line);
        const bool goes_on = !line.empty() && line.back() == '\\';
        if (std::exchange(continued, goes_on) || isComment(line)) continue;
        if (line[0] != '[') {
            if (sections.empty()) {
                refuse(path, number, "a line before the first section",
                       "begin with [global] or the [SECTION] of a sensor");
            }
            if (line.find('=') == std::string::npos) {
                refuse(path, number, "'" + line + "' is neither section, key nor comment",
                       "write KEY = VALUE");
            }
            continue;
        }
        const auto end = line.find(']');
        if (end == std::string::npos || end == 1) {
            refuse(path, number, "'" + line + "' is no section", "write [NAME]");
        }
        const std::string section = line.substr(1, end - 1);
        if (std::count(sections.begin(), sections.end(), section) > 0) {
            refuse(path, number, "section [" + section + "] is there twice",
                   "give every sensor a section of its own");
        }
        sections.push_back(section);
    }
    return sections;
}

std::string inSection(const SensorFile& file, const std::string& section) {
    return file.path + ": section [" + section + "]: ";
}

/** \param otherwise where the key is absent */
double numberOf(const SensorFile& file, const std::string& section, const std::string& key,
                const std::string& otherwise, double min, double max) {
    const std::string text = file.config.read_string(section, key, otherwise);
    std::size_t read = 0;
    double value = NAN;
    try {
        value = std::stod(text, &read);
    } catch (const std::exception&) {
        read = 0;
    }
    if (read == text.size() && value >= min && value <= max) return value;
    std::ostringstream range;
    range << "give " << key << " a number from " << min << " to " << max;
    throw Error(inSection(file, section) + key + " = '" + text + "' makes no sense", range.str());
}

SensorSection sensorOf(const SensorFile& file, const std::string& section) {
    SensorSection sensor;
    sensor.name = section;
    sensor.driver = stripped(file.config.read_string(section, "driver", ""));
    if (sensor.driver.empty()) {
        throw Error(inSection(file, section) + "no driver",
                    "add the class of the sensor, such as driver = COpenNI2Sensor");
    }
    if (!file.config.keyExists(section, "process_rate")) {
        throw Error(inSection(file, section) + "no process_rate",
                    "add how often the sensor is asked, such as process_rate = 60  // Hz");
    }
    sensor.process_rate_hz = numberOf(file, section, "process_rate", "", 0.01, 10000);
    return sensor;
}

}  // namespace

SensorFile parseSensorFile(const std::string& text, const std::string& path) {
    refuseFormulas(text, path);
    const std::vector<std::string> sections = sectionsOf(text, path);
    SensorFile file;
    file.path = path;
    file.config.setContent(text);
    file.time_between_launches_ms =
        static_cast<int>(numberOf(file, global, "time_between_launches", "300", 0, 600000));
    for (const std::string& section : sections) {
        const bool ignored = file.config.read_bool(section, "rawlog-grabber-ignore", false);
        if (section.empty() || section == global || ignored) continue;
        file.sensors.push_back(sensorOf(file, section));
    }
    if (!file.sensors.empty()) return file;
    throw Error(path + ": no sensor", "add a section with driver and process_rate for each");
}

SensorFile readSensorFile(const std::string& path) {
    return parseSensorFile(
        readTextFile(path, "an ini file", "give --live the ini file of the sensors"), path);
}

}  // namespace rgbd_graphslam
