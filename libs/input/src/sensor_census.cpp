#include "rgbd_graphslam/input/sensor_census.h"

#include <algorithm>

namespace rgbd_graphslam {

std::string classNameOf(const mrpt::obs::CObservation& observation) {
    const std::string name = observation.GetRuntimeClass()->className;
    const auto colons = name.rfind("::");
    return colons == std::string::npos ? name : name.substr(colons + 2);
}

void SensorCensus::note(const mrpt::obs::CObservation& observation, bool used) {
    const std::string name = classNameOf(observation);
    const auto same = [&](const SensorRecord& sensor) {
        return sensor.label == observation.sensorLabel && sensor.class_name == name;
    };
    auto found = std::find_if(sensors_.begin(), sensors_.end(), same);
    if (found == sensors_.end()) {
        sensors_.push_back({observation.sensorLabel, name});
        found = sensors_.end() - 1;
    }
    ++found->count;
    found->used = found->used || used;
}

void SensorCensus::leaveOut(const std::string& label) {
    for (SensorRecord& sensor : sensors_) {
        if (sensor.label == label) sensor.used = false;
    }
}

std::string sensorsText(const std::vector<SensorRecord>& sensors, bool used) {
    std::string text;
    for (const SensorRecord& sensor : sensors) {
        if (sensor.used != used || sensor.class_name == "CObservationComment") continue;
        text += (text.empty() ? "'" : ", '") + sensor.label + "' (" + sensor.class_name + ", " +
                std::to_string(sensor.count) + ")";
    }
    return text.empty() ? "none" : text;
}

std::string severalCamerasText(const std::vector<SensorRecord>& sensors) {
    std::string text;
    std::size_t cameras = 0;
    for (const SensorRecord& sensor : sensors) {
        if (!sensor.isCamera()) continue;
        text += (cameras++ ? ", '" : "'") + sensor.label + "' (" + std::to_string(sensor.count) +
                (sensor.used ? " frames, used)" : " frames)");
    }
    return cameras > 1 ? text : std::string();
}

}  // namespace rgbd_graphslam
