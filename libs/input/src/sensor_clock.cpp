#include "sensor_clock.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {

SensorClock::Verdict SensorClock::note(const std::string& sensor, double stamp_s,
                                       double arrival_s) {
    const double lead_s = stamp_s - arrival_s;
    const auto [entry, is_new] =
        sensors_.try_emplace(sensor, Sensor{stamp_s, arrival_s, lead_s, 0, false});
    Sensor& known = entry->second;
    const double step_s = stamp_s - known.stamp_s, passed_s = arrival_s - known.arrival_s;
    const bool forward = !is_new && step_s - passed_s > smallest_jump_s &&
                         lead_s > known.greatest_lead_s + smallest_jump_s;
    const bool back = step_s < -smallest_jump_s;
    if (back && !known.suspected) {
        known.suspected = true;
        return {known.correction_s, std::nullopt, true};
    }
    Verdict verdict;
    if (forward || back) {
        verdict.jump_s = common(step_s - passed_s, arrival_s);
        known.correction_s -= *verdict.jump_s;
        known.greatest_lead_s = lead_s;
    }
    known.greatest_lead_s = std::max(known.greatest_lead_s, lead_s);
    known.suspected = false;
    if (forward || back || step_s >= 0) {
        known.stamp_s = stamp_s;
        known.arrival_s = arrival_s;
    }
    verdict.correction_s = known.correction_s;
    return verdict;
}

/** What another sensor has jumped by just before, if that is about the same. */
double SensorClock::common(double jump_s, double arrival_s) {
    constexpr double together_s = 5, alike_s = 0.3;
    const bool together = last_ && arrival_s - last_->arrival_s < together_s &&
                          std::abs(jump_s - last_->by_s) < alike_s;
    if (!together) last_ = Jump{arrival_s, jump_s};
    return last_->by_s;
}

}  // namespace rgbd_graphslam
