#include "rgbd_graphslam/sensors/live_sensors.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "sensor_driver.h"

namespace rgbd_graphslam {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

constexpr milliseconds retry_interval(1000), watch_interval(100);

double secondsSince(Clock::time_point moment) {
    return std::chrono::duration<double>(Clock::now() - moment).count();
}

}  // namespace

class LiveSensors::Implementation {
  public:
    Implementation(SensorFile file, std::shared_ptr<LiveSource> source)
        : file_(std::move(file)), source_(std::move(source)), grabbers_(file_.sensors.size()) {
        try {
            startAll();
        } catch (...) {
            stop();
            throw;
        }
        watcher_ = std::thread([this] { watch(); });
    }
    ~Implementation() { stop(); }

  private:
    /** A sensor and its thread. */
    struct Grabber {
        std::thread thread;
        std::atomic<bool> sent{false}, ended{false};
        bool silence_told = false;
    };

    void startAll() {
        for (std::size_t i = 0; i < grabbers_.size(); ++i) {
            if (i > 0) pause(milliseconds(file_.time_between_launches_ms));
            std::promise<void> started;
            auto result = started.get_future();
            grabbers_[i].thread = std::thread(
                [this, i, started = std::move(started)]() mutable { run(i, std::move(started)); });
            result.get();
        }
    }

    /** A sensor is made, started, read and let go in its own thread, as some drivers want. */
    void run(std::size_t i, std::promise<void> started) {
        const SensorSection& section = file_.sensors[i];
        std::unique_ptr<SensorDriver> driver;
        try {
            driver = std::make_unique<SensorDriver>(file_, section);
            try {
                driver->start();
            } catch (const Error& e) {
                throw Error(file_.path + ": section [" + section.name + "]: the sensor does not " +
                                "start: " + e.what(),
                            "check that it is plugged in, and its settings");
            }
        } catch (...) {
            started.set_exception(std::current_exception());
            return;
        }
        started.set_value();
        grab(section, *driver, grabbers_[i]);
        grabbers_[i].ended = true;
    }

    void grab(const SensorSection& section, SensorDriver& driver, Grabber& grabber) {
        const auto period = duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / section.process_rate_hz));
        auto next = Clock::now();
        while (!stopped_ && !driver.ended() && !source_->isClosed()) {
            try {
                for (auto& observation : driver.read()) {
                    grabber.sent = true;
                    source_->push(std::move(observation));
                }
            } catch (const Error& e) {
                if (!restart(section, driver, e.what())) return;
            }
            next = std::max(next + period, Clock::now() - period);
            pause(std::max(milliseconds(0), duration_cast<milliseconds>(next - Clock::now())));
        }
    }

    /** \return false when stopped before it runs again */
    bool restart(const SensorSection& section, SensorDriver& driver, const std::string& reason) {
        const auto failed = Clock::now();
        source_->noteFailure("sensor [" + section.name + "] failed: " + reason +
                             "; trying again every second");
        while (pause(retry_interval) && !source_->isClosed()) {
            try {
                driver.start();
                sayInfo(formatted("sensor [%s] runs again after %.1f s", section.name.c_str(),
                                  secondsSince(failed)));
                return true;
            } catch (const Error& e) {
                sayDetail("sensor [" + section.name + "]: " + e.what());
            }
        }
        return false;
    }

    /** Interrupted by stop(). \return false then */
    bool pause(milliseconds time) {
        std::unique_lock<std::mutex> lock(mutex_);
        stop_wanted_.wait_for(lock, time, [this] { return stopped_.load(); });
        return !stopped_;
    }

    void watch() {
        const auto begun = Clock::now();
        while (pause(watch_interval)) {
            source_->reportSilence();
            if (secondsSince(begun) > 2) reportMute();
            const bool all_ended =
                std::all_of(grabbers_.begin(), grabbers_.end(),
                            [](const Grabber& grabber) { return grabber.ended.load(); });
            if (!all_ended) continue;
            source_->close();
            return;
        }
    }

    /** Those that have never sent anything. */
    void reportMute() {
        for (std::size_t i = 0; i < grabbers_.size(); ++i) {
            Grabber& grabber = grabbers_[i];
            if (grabber.sent || grabber.ended || std::exchange(grabber.silence_told, true))
                continue;
            sayWarning("sensor [" + file_.sensors[i].name + "] has sent nothing yet");
        }
    }

    void stop() {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            stopped_ = true;
        }
        stop_wanted_.notify_all();
        if (watcher_.joinable()) watcher_.join();
        for (Grabber& grabber : grabbers_) {
            if (grabber.thread.joinable()) grabber.thread.join();
        }
    }

    const SensorFile file_;
    const std::shared_ptr<LiveSource> source_;
    std::mutex mutex_;
    std::condition_variable stop_wanted_;
    std::atomic<bool> stopped_{false};
    std::vector<Grabber> grabbers_;
    std::thread watcher_;
};

LiveSensors::LiveSensors(const SensorFile& file, std::shared_ptr<LiveSource> source)
    : impl_(std::make_unique<Implementation>(file, std::move(source))) {}

LiveSensors::~LiveSensors() = default;

}  // namespace rgbd_graphslam
