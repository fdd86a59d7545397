#include "rgbd_graphslam/input/live_source.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "live_sensor.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/input/frame_stream.h"
#include "rgbd_graphslam/input/sensor_census.h"
#include "sensor_clock.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
namespace {

/** Of readings that wait, should tracking stand still. */
constexpr std::size_t most_readings = 20000;

/** Before tracking has caught up for the first time: two seconds at 30 Hz. */
constexpr int most_waiting_at_start = 60;
constexpr double longest_start_s = 2;

constexpr std::chrono::milliseconds poll_interval(50);

double inSeconds(LiveSource::Clock::time_point moment) {
    return std::chrono::duration<double>(moment.time_since_epoch()).count();
}

}  // namespace

class LiveSource::Implementation {
  public:
    explicit Implementation(const LiveOptions& options) : options_(options) {}

    void recordTo(const std::string& path) {
        recorder_ = std::make_unique<LiveRecorder>(path, survey_frames);
    }
    void endAfter(double seconds) { duration_s_ = seconds; }
    void endWhen(std::function<bool()> wanted) {
        const std::lock_guard<std::mutex> lock(mutex_);
        end_wanted_ = std::move(wanted);
    }

    void push(CObservation::Ptr observation, Clock::time_point arrival) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (closed_) return;
        const double arrival_s = inSeconds(arrival);
        LiveSensor& sensor = sensorOf(*observation);
        if (!correctStamp(*observation, arrival_s, sensor)) return;
        const double stamp_s = toSeconds(observation->timestamp);
        if (const auto silent_s = sensor.note(stamp_s, arrival_s)) {
            sayInfo(formatted("sensor '%s' is back after %.1f s", sensor.statistics.label.c_str(),
                              *silent_s));
        }
        insert({std::move(observation), stamp_s, arrival_s, &sensor});
        changed_.notify_all();
    }

    void noteFailure(const std::string& text) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            ++failures_;
            if (recorder_) recorder_->comment(text);
        }
        sayWarning(text);
    }

    void reportSilence(Clock::time_point now) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (auto& [label, sensor] : sensors_) {
            const auto since_s = sensor.newlySilent(inSeconds(now), options_);
            if (!since_s || closed_) continue;
            tell(sensor.statistics.silences,
                 formatted("sensor '%s' has sent nothing for %.1f s", label.c_str(), *since_s));
        }
    }

    void close() {
        const std::lock_guard<std::mutex> lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }
    void end() {
        const std::lock_guard<std::mutex> lock(mutex_);
        closed_ = ended_ = true;
        changed_.notify_all();
    }

    bool isClosed() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        return closed_;
    }

    CObservation::Ptr next() {
        std::unique_lock<std::mutex> lock(mutex_);
        while (released_.empty()) {
            if (isAtEnd()) return nullptr;
            if (release(inSeconds(Clock::now()))) break;
            if (closed_) return nullptr;
            changed_.wait_for(lock, waitingTime());
        }
        auto observation = std::move(released_.front());
        released_.pop_front();
        return observation;
    }

    void notePose(const std::string& label, mrpt::Clock::time_point stamp) {
        const std::lock_guard<std::mutex> lock(mutex_);
        noteLatency({label, stamp}, latencies_ms_);
    }

    void noteTracked(const std::string& label, mrpt::Clock::time_point stamp) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            noteLatency({label, stamp}, completions_ms_);
            forgetArrival({label, stamp});
        }
        if (recorder_) recorder_->commit(label, stamp);  // may wait for the disk
    }

    bool finishRecord() {
        if (!recorder_) return false;
        try {
            recorder_->finish();
            return true;
        } catch (const Error& e) {
            sayWarning(e.what());
            return false;
        }
    }

    LiveStatistics statistics() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        LiveStatistics all;
        for (const std::string& label : order_) {
            all.sensors.push_back(sensors_.at(label).statistics);
        }
        all.latencies_ms = latencies_ms_;
        all.completions_ms = completions_ms_;
        all.starting_frames = starting_frames_;
        all.failures = failures_;
        return all;
    }

  private:
    struct Measurement {
        CObservation::Ptr observation;
        double stamp_s = 0, arrival_s = 0;
        LiveSensor* sensor = nullptr;
    };
    using ImageKey = std::pair<std::string, mrpt::Clock::time_point>;

    LiveSensor& sensorOf(const CObservation& observation) {
        const std::string& label = observation.sensorLabel;
        const auto known = sensors_.find(label);
        if (known != sensors_.end()) return known->second;
        SensorRecord record;
        record.class_name = classNameOf(observation);
        order_.push_back(label);
        return sensors_.emplace(label, LiveSensor(label, record.class_name, record.isCamera()))
            .first->second;
    }

    /** \return false when the measurement is dropped */
    bool correctStamp(CObservation& observation, double arrival_s, LiveSensor& sensor) {
        const auto verdict =
            clock_.note(sensor.statistics.label, toSeconds(observation.timestamp), arrival_s);
        if (verdict.jump_s) {
            ++sensor.statistics.clock_jumps;
            tell(sensor.statistics.clock_jumps,
                 formatted("the clock of sensor '%s' was set by %+.1f s; its stamps are corrected",
                           sensor.statistics.label.c_str(), *verdict.jump_s));
        }
        if (verdict.belated) {
            ++sensor.statistics.received;
            ++sensor.statistics.late;
            return false;
        }
        if (verdict.correction_s != 0) {
            observation.timestamp += std::chrono::duration_cast<mrpt::Clock::duration>(
                std::chrono::duration<double>(verdict.correction_s));
        }
        return true;
    }

    static bool earlier(double stamp_s, const Measurement& other) {
        return stamp_s < other.stamp_s;
    }

    void insert(Measurement measurement) {
        const auto& handed_out = measurement.sensor->handed_out_stamp_s;
        const bool overtaken = handed_out && measurement.stamp_s <= *handed_out;
        const bool too_late =
            last_image_s_ && measurement.stamp_s < *last_image_s_ - options_.late_s;
        if (overtaken || too_late) {
            ++measurement.sensor->statistics.late;
            return;
        }
        auto& list = measurement.sensor->is_camera ? images_ : readings_;
        const auto place = std::upper_bound(list.begin(), list.end(), measurement.stamp_s, earlier);
        LiveSensor& sensor = *measurement.sensor;
        if (sensor.is_camera) noteStart(measurement.arrival_s);
        list.insert(place, std::move(measurement));
        if (sensor.is_camera) {
            makeRoom(sensor);
        } else if (readings_.size() > most_readings) {
            ++readings_.front().sensor->statistics.late;
            readings_.pop_front();
        }
    }

    /** Frames that waited for the survey and for the first map are not those of a running robot. */
    void noteStart(double arrival_s) {
        if (caught_up_s_ || !first_tracked_s_) return;
        const bool idle = images_.empty() && arrivals_.empty();
        if (idle || arrival_s > *first_tracked_s_ + longest_start_s) caught_up_s_ = arrival_s;
    }

    int mostWaiting() const {
        const int most = options_.max_waiting_frames;
        return caught_up_s_ ? most : std::max(most, most_waiting_at_start);
    }

    /** The newest images win; what another camera took at the moment of a dropped one goes, too. */
    void makeRoom(const LiveSensor& camera) {
        const auto of_camera = [&](const Measurement& image) { return image.sensor == &camera; };
        const auto waiting = std::count_if(images_.begin(), images_.end(), of_camera);
        if (waiting <= mostWaiting()) return;
        const double stamp_s = std::find_if(images_.begin(), images_.end(), of_camera)->stamp_s;
        const auto gone =
            std::stable_partition(images_.begin(), images_.end(), [&](const Measurement& image) {
                return std::abs(image.stamp_s - stamp_s) > FrameStream::same_moment_s;
            });
        for (auto image = gone; image != images_.end(); ++image) drop(*image);
        images_.erase(gone, images_.end());
    }

    void drop(const Measurement& image) {
        ++image.sensor->statistics.dropped;
        ++dropped_;
        const std::string text =
            formatted("tracking is behind: the frame of '%s' at %.6f s is dropped, %zu in all",
                      image.sensor->statistics.label.c_str(), image.stamp_s, dropped_);
        if (recorder_) recorder_->comment(text);
        if (image.arrival_s - told_drop_s_ < 1) return;
        told_drop_s_ = image.arrival_s;
        dropped_ == 1 ? sayWarning(text) : sayInfo(text);
    }

    /** Warns of the first few; summary.json has the number of all. */
    void tell(std::size_t times, const std::string& text) {
        constexpr std::size_t most_warnings = 3;
        if (recorder_) recorder_->comment(text);
        times <= most_warnings ? sayWarning(text) : sayInfo(text);
    }

    bool isAtEnd() {
        const bool over = duration_s_ && first_release_s_ &&
                          inSeconds(Clock::now()) - *first_release_s_ >= *duration_s_;
        if (over || (end_wanted_ && end_wanted_())) closed_ = ended_ = true;
        return ended_;
    }

    /** Hands out the next image with what comes before it, or readings that have waited enough.
     *  \return whether there was any */
    bool release(double now_s) {
        if (images_.empty()) return releaseReadings(now_s);
        const Measurement& image = images_.front();
        if (!closed_ && isWorthWaiting(image, now_s)) return false;
        while (!readings_.empty() && readings_.front().stamp_s <= image.stamp_s) {
            handOut(readings_.front());
            readings_.pop_front();
        }
        last_image_s_ = image.stamp_s;
        if (!first_release_s_) first_release_s_ = now_s;
        arrivals_[{image.observation->sensorLabel, image.observation->timestamp}] = image.arrival_s;
        handOut(image);
        images_.pop_front();
        return true;
    }

    bool releaseReadings(double now_s) {
        bool any = false;
        while (!readings_.empty() &&
               (closed_ || now_s - readings_.front().arrival_s > options_.late_s)) {
            handOut(readings_.front());
            readings_.pop_front();
            any = true;
        }
        return any;
    }

    bool isWorthWaiting(const Measurement& image, double now_s) const {
        if (now_s >= image.arrival_s + 1e-3 * options_.wait_ms) return false;
        return std::any_of(sensors_.begin(), sensors_.end(), [&](const auto& entry) {
            return &entry.second != image.sensor && entry.second.owes(image.stamp_s, now_s);
        });
    }

    Clock::duration waitingTime() const {
        const Clock::duration poll = poll_interval;
        if (images_.empty()) return poll;
        return std::min<Clock::duration>(
            poll, std::chrono::microseconds(static_cast<long>(1e3 * options_.wait_ms) / 4 + 100));
    }

    void handOut(const Measurement& measurement) {
        measurement.sensor->handed_out_stamp_s = measurement.stamp_s;
        if (recorder_) recorder_->note(measurement.observation);
        released_.push_back(measurement.observation);
    }

    void noteLatency(const ImageKey& image, std::vector<double>& latencies_ms) const {
        const auto arrival = arrivals_.find(image);
        if (arrival == arrivals_.end() || isOfStart(arrival->second)) return;
        latencies_ms.push_back(1e3 * (inSeconds(Clock::now()) - arrival->second));
    }

    bool isOfStart(double arrival_s) const { return !caught_up_s_ || arrival_s < *caught_up_s_; }

    /** And those of images that nobody asked for. */
    void forgetArrival(const ImageKey& image) {
        const auto arrival = arrivals_.find(image);
        if (arrival == arrivals_.end()) return;
        if (!first_tracked_s_) first_tracked_s_ = inSeconds(Clock::now());
        starting_frames_ += isOfStart(arrival->second);
        const double passed_over_s = arrival->second - 5;
        for (auto other = arrivals_.begin(); other != arrivals_.end();) {
            const bool gone = other->first == image || other->second < passed_over_s;
            other = gone ? arrivals_.erase(other) : std::next(other);
        }
    }

    const LiveOptions options_;
    std::optional<double> duration_s_;
    std::function<bool()> end_wanted_;

    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    SensorClock clock_;
    std::map<std::string, LiveSensor> sensors_;
    std::vector<std::string> order_;
    std::deque<Measurement> images_, readings_;  // by their stamps
    std::deque<CObservation::Ptr> released_;
    std::map<ImageKey, double> arrivals_;  // of images that are not tracked yet
    std::optional<double> last_image_s_, first_release_s_, first_tracked_s_, caught_up_s_;
    std::vector<double> latencies_ms_, completions_ms_;
    std::size_t starting_frames_ = 0, failures_ = 0, dropped_ = 0;
    double told_drop_s_ = 0;
    bool closed_ = false, ended_ = false;
    std::unique_ptr<LiveRecorder> recorder_;
};

std::size_t LiveStatistics::dropped() const {
    std::size_t all = 0;
    for (const LiveSensorStatistics& sensor : sensors) all += sensor.dropped;
    return all;
}

std::size_t LiveStatistics::late() const {
    std::size_t all = 0;
    for (const LiveSensorStatistics& sensor : sensors) all += sensor.late;
    return all;
}

LiveSource::LiveSource(const LiveOptions& options, const std::string& name)
    : name_(name), impl_(std::make_unique<Implementation>(options)) {}

LiveSource::~LiveSource() = default;

void LiveSource::recordTo(const std::string& path) {
    impl_->recordTo(path);
}

void LiveSource::endAfter(double seconds) {
    impl_->endAfter(seconds);
}

void LiveSource::endWhen(std::function<bool()> wanted) {
    impl_->endWhen(std::move(wanted));
}

void LiveSource::push(CObservation::Ptr observation, Clock::time_point arrival) {
    impl_->push(std::move(observation), arrival);
}

void LiveSource::noteFailure(const std::string& text) {
    impl_->noteFailure(text);
}

void LiveSource::reportSilence(Clock::time_point now) {
    impl_->reportSilence(now);
}

void LiveSource::close() {
    impl_->close();
}

void LiveSource::end() {
    impl_->end();
}

bool LiveSource::isClosed() const {
    return impl_->isClosed();
}

CObservation::Ptr LiveSource::next() {
    return impl_->next();
}

std::string LiveSource::cameraRemedy() const {
    return "check that the camera is plugged in and sends color and depth";
}

void LiveSource::notePose(const std::string& label, mrpt::Clock::time_point stamp) {
    impl_->notePose(label, stamp);
}

void LiveSource::noteTracked(const std::string& label, mrpt::Clock::time_point stamp) {
    impl_->noteTracked(label, stamp);
}

bool LiveSource::finishRecord() {
    return impl_->finishRecord();
}

LiveStatistics LiveSource::statistics() const {
    return impl_->statistics();
}

}  // namespace rgbd_graphslam
