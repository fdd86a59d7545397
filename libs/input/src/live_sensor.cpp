#include "live_sensor.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** Silent for as many periods, a sensor is not waited for. */
constexpr double periods_of_silence = 3;

/** Cameras that are triggered together differ by less. */
constexpr double same_moment_s = 0.004;

}  // namespace

std::optional<double> LiveSensor::note(double stamp_s, double arrival_s) {
    constexpr double smoothing = 0.1;
    std::optional<double> was_silent_s;
    if (silent_) was_silent_s = arrival_s - arrival_s_;
    const double step_s = stamp_s - stamp_s_;
    if (statistics.received > 0 && !silent_ && step_s > 0) {
        period_s_ = period_s_ > 0 ? (1 - smoothing) * period_s_ + smoothing * step_s : step_s;
    }
    if (was_silent_s) {
        statistics.longest_silence_s = std::max(statistics.longest_silence_s, *was_silent_s);
    }
    silent_ = false;
    ++statistics.received;
    stamp_s_ = statistics.received == 1 ? stamp_s : std::max(stamp_s_, stamp_s);
    arrival_s_ = arrival_s;
    return was_silent_s;
}

bool LiveSensor::owes(double stamp_s, double now_s) const {
    if (period_s_ <= 0 || stamp_s_ >= stamp_s) return false;
    if (now_s - arrival_s_ > periods_of_silence * period_s_) return false;
    return stamp_s_ + period_s_ <= stamp_s + (is_camera ? same_moment_s : 0);
}

std::optional<double> LiveSensor::newlySilent(double now_s, const LiveOptions& options) {
    const double since_s = now_s - arrival_s_;
    if (statistics.received == 0) return std::nullopt;
    if (since_s < std::max(options.silence_s, periods_of_silence * period_s_)) return std::nullopt;
    statistics.longest_silence_s = std::max(statistics.longest_silence_s, since_s);
    if (silent_) return std::nullopt;
    silent_ = true;
    ++statistics.silences;
    return since_s;
}

}  // namespace rgbd_graphslam
