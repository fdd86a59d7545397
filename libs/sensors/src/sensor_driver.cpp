#include "sensor_driver.h"

#include <mrpt/hwdrivers/COpenNI2Sensor.h>

#include <algorithm>
#include <utility>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/sensors/rawlog_replay_sensor.h"

namespace rgbd_graphslam {
namespace {

/** MRPT's messages are reports of many lines; the first line of the reason is enough. */
std::string reasonOf(const std::exception& e) {
    const auto* of_mrpt = dynamic_cast<const mrpt::ExceptionWithCallBackBase*>(&e);
    std::string text = of_mrpt ? of_mrpt->originalWhat : e.what();
    const auto from = text.find_first_not_of(" \n\r\t");
    if (from == std::string::npos) return "no reason given";
    text = text.substr(from);
    return text.substr(0, text.find('\n'));
}

mrpt::hwdrivers::CGenericSensor::Ptr makeSensor(const std::string& driver,
                                                const std::string& where) {
    CRawlogReplaySensor::doRegister();
    try {
        if (auto sensor = mrpt::hwdrivers::CGenericSensor::createSensorPtr(driver)) return sensor;
    } catch (const std::exception& e) {  // CKinect without Kinect support
        throw Error(where + "driver " + driver + " cannot be used: " + reasonOf(e),
                    "use another driver or another build of MRPT");
    }
    throw Error(where + "driver = '" + driver + "' is unknown",
                "name a sensor class of MRPT, such as COpenNI2Sensor, CCameraSensor, CHokuyoURG, "
                "CIMUXSens_MT4, CGPSInterface or CRawlogReplaySensor");
}

/** COpenNI2Sensor says nothing where there is no device, and ends the program when it is read. */
void requireDevice(const mrpt::hwdrivers::CGenericSensor& sensor) {
    const auto* camera = dynamic_cast<const mrpt::hwdrivers::COpenNI2Sensor*>(&sensor);
    if (camera && camera->getNumDevices() == 0) throw Error("OpenNI2 finds no camera");
}

}  // namespace

SensorDriver::SensorDriver(const SensorFile& file, const SensorSection& section) {
    const std::string where = file.path + ": section [" + section.name + "]: ";
    sensor_ = makeSensor(section.driver, where);
    try {
        sensor_->loadConfig(file.config, section.name);
    } catch (const std::exception& e) {
        throw Error(where + reasonOf(e));
    }
    if (!file.config.keyExists(section.name, "sensorLabel")) {
        sensor_->setSensorLabel(section.name);
    }
}

SensorDriver::~SensorDriver() {
    if (works_ || !sensor_) return;
    static auto* const abandoned = new std::vector<mrpt::hwdrivers::CGenericSensor::Ptr>;
    abandoned->push_back(std::move(sensor_));
}

void SensorDriver::start() {
    try {
        sensor_->initialize();
        requireDevice(*sensor_);
        works_ = true;
    } catch (const std::exception& e) {
        works_ = false;
        throw Error(reasonOf(e));
    }
}

std::vector<mrpt::obs::CObservation::Ptr> SensorDriver::read() {
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    try {
        sensor_->doProcess();
        for (const auto& [stamp, object] : sensor_->getObservations()) {
            auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
            if (observation) observations.push_back(std::move(observation));
        }
    } catch (const std::exception& e) {
        works_ = false;
        throw Error(reasonOf(e));
    }
    return observations;
}

bool SensorDriver::ended() const {
    const auto* replay = dynamic_cast<const CRawlogReplaySensor*>(sensor_.get());
    return replay && replay->ended();
}

}  // namespace rgbd_graphslam
