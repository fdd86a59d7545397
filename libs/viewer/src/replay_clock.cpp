#include "rgbd_graphslam/viewer/replay_clock.h"

#include <utility>

#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {

void ReplayClock::reset(double first_s, double last_s) {
    first_s_ = first_s;
    last_s_ = last_s;
    moveTo(std::nullopt);
}

void ReplayClock::moveTo(std::optional<double> stamp_s) {
    now_s_ = stamp_s;
    if (!stamp_s) playing_ = false;
}

void ReplayClock::moveToShare(double share) {
    moveTo(share < 1 ? std::optional(first_s_ + share * span_s()) : std::nullopt);
}

void ReplayClock::play(bool play, TimePoint now) {
    playing_ = play && span_s() > 0;
    if (playing_ && !now_s_) now_s_ = first_s_;
    last_advance_ = now;
}

bool ReplayClock::advance(TimePoint now) {
    if (!playing_) return false;
    const std::chrono::duration<double> passed = now - std::exchange(last_advance_, now);
    const double stamp_s = *now_s_ + passed.count();
    moveTo(stamp_s < last_s_ ? std::optional(stamp_s) : std::nullopt);
    return true;
}

double ReplayClock::share() const {
    return now_s_ && span_s() > 0 ? (*now_s_ - first_s_) / span_s() : 1;
}

std::string ReplayClock::text() const {
    return formatted("%.1f / %.1f s", now_s_.value_or(last_s_) - first_s_, span_s());
}

}  // namespace rgbd_graphslam
