#include "rgbd_graphslam/sensors/rawlog_replay_sensor.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "replay_settings.h"
#include "replay_timeline.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

IMPLEMENTS_GENERIC_SENSOR(CRawlogReplaySensor, rgbd_graphslam)

namespace {

using Clock = std::chrono::steady_clock;

/** How far ahead the file is read: decoding an image takes its time. */
constexpr double ahead_s = 0.15;

/** When the replay of a rawlog began, for all sections that replay it. */
Clock::time_point beginningOf(const std::string& rawlog) {
    static std::mutex access;
    static std::map<std::string, Clock::time_point> beginnings;
    const std::lock_guard<std::mutex> lock(access);
    return beginnings.try_emplace(std::filesystem::absolute(rawlog).string(), Clock::now())
        .first->second;
}

}  // namespace

class CRawlogReplaySensor::Implementation {
  public:
    ReplaySettings settings;
    std::optional<ReplayTimeline> timeline;
    Clock::time_point beginning;

    double now() const {
        return settings.speed * std::chrono::duration<double>(Clock::now() - beginning).count();
    }

    void requirePlugged() const {
        if (!settings.unplugged(now())) return;
        throw std::runtime_error("unplugged, as unplug_every_s asks for");
    }

    /** A damaged rawlog ends there. */
    void readUntil(double time_s) {
        try {
            timeline->readUntil(time_s);
        } catch (const Error& e) {
            sayWarning(e.what());
        }
    }

    /** What was due while nobody read. */
    void passOver() {
        const double now_s = now();
        readUntil(now_s);
        while (timeline->take(now_s)) continue;
    }

    void waitForNext() const {
        constexpr double longest_s = 0.01;
        const double due_s = timeline->nextDue().value_or(now() + longest_s * settings.speed);
        const double wait_s = std::clamp((due_s - now()) / settings.speed, 0.0, longest_s);
        std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    }
};

CRawlogReplaySensor::CRawlogReplaySensor() : impl_(std::make_unique<Implementation>()) {}

CRawlogReplaySensor::~CRawlogReplaySensor() = default;

void CRawlogReplaySensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                                    const std::string& section) {
    impl_->settings = replaySettings(config, section);
    m_sensorLabel = config.read_string(section, "sensorLabel", section);
}

void CRawlogReplaySensor::initialize() {
    const bool again = impl_->timeline.has_value();
    if (!again) {
        impl_->timeline.emplace(impl_->settings);
        impl_->readUntil(ahead_s);
        impl_->beginning = beginningOf(impl_->settings.rawlog);
    }
    impl_->requirePlugged();
    if (again) impl_->passOver();
    m_state = ssWorking;
}

void CRawlogReplaySensor::doProcess() {
    impl_->requirePlugged();
    impl_->waitForNext();
    const double now_s = impl_->now();
    while (const auto observation = impl_->timeline->take(now_s)) appendObservation(observation);
    impl_->readUntil(now_s + ahead_s * impl_->settings.speed);
}

bool CRawlogReplaySensor::ended() const {
    return impl_->timeline && !impl_->timeline->nextDue();
}

}  // namespace rgbd_graphslam
