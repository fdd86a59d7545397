#include "rgbd_graphslam/dataset/sensor_import.h"

#include <cstdio>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/sensor_hints.h"
#include "sensor_entries.h"

namespace rgbd_graphslam {

std::string toText(const SensorReport& report) {
    std::string text;
    for (const std::string& note : report.notes) text += note + "\n";
    char line[160];
    std::snprintf(line, sizeof line,
                  "%zu IMU readings, %zu odometry readings, %zu of other sensors over %.2f s\n",
                  report.imu, report.odometry, report.others, report.duration_s);
    return text + line;
}

SensorReport importSensors(const RgbdSequence& sequence, const std::string& rawlog_path) {
    ImportReport counts;
    const SensorEntries entries =
        sensorEntries(sequence, sequence.camera ? *sequence.camera : CameraSetup(), counts);
    if (entries.empty()) {
        throw Error("there are no sensor readings to write", "give a recording of a robot");
    }
    writeRawlog(rawlog_path, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (const auto& entry : entries) writer.write(*entry);
    });
    for (const std::string& hint : sensorHints(sequence)) sayWarning(hint);
    const double duration_s =
        toSeconds(entries.back()->timestamp) - toSeconds(entries.front()->timestamp);
    return {counts.imu, counts.odometry, counts.others, duration_s, sequence.notes};
}

}  // namespace rgbd_graphslam
