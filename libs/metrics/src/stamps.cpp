#include "rgbd_graphslam/metrics/stamps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string spanOf(const Trajectory& trajectory) {
    if (trajectory.empty()) return "without poses";
    char text[128];
    std::snprintf(text, sizeof(text), "%.4f s to %.4f s (%zu poses)", trajectory.front().stamp_s,
                  trajectory.back().stamp_s, trajectory.size());
    return text;
}

}  // namespace

Trajectory withUniqueStamps(const Trajectory& trajectory) {
    Trajectory unique;
    for (const auto& pose : trajectory) {
        if (!unique.empty() && unique.back().stamp_s == pose.stamp_s) unique.pop_back();
        unique.push_back(pose);
    }
    return unique;
}

std::vector<double> stampsOf(const Trajectory& trajectory) {
    std::vector<double> stamps;
    stamps.reserve(trajectory.size());
    for (const auto& pose : trajectory) stamps.push_back(pose.stamp_s);
    return stamps;
}

std::size_t nearestIndex(const std::vector<double>& ascending, double wanted) {
    const auto above = std::lower_bound(ascending.begin(), ascending.end(), wanted);
    if (above == ascending.begin()) return 0;
    if (above == ascending.end()) return ascending.size() - 1;
    const bool lower_is_nearer = wanted - *(above - 1) <= *above - wanted;
    return (above - ascending.begin()) - (lower_is_nearer ? 1 : 0);
}

void checkScale(double scale) {
    if (!std::isfinite(scale) || scale <= 0) {
        throw Error("the scale " + std::to_string(scale) + " is none", "give a positive number");
    }
}

std::string secondsText(double seconds) {
    char text[32];
    std::snprintf(text, sizeof(text), "%g s", seconds);
    return text;
}

std::string spansOf(const Trajectory& estimate, const Trajectory& truth) {
    return "estimate " + spanOf(estimate) + ", truth " + spanOf(truth);
}

}  // namespace rgbd_graphslam
