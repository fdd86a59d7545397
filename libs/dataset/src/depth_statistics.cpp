#include "rgbd_graphslam/dataset/depth_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rgbd_graphslam {
namespace {

constexpr int stride = 4;
constexpr double nearest_median_m = 0.2, farthest_median_m = 15;
constexpr double nearest_usual_m = 0.5, farthest_usual_m = 8;
/** Of merely assumed units: share of readings nearer than sensors see, and a room's width. */
constexpr double share_in_doubt = 0.2, room_m = 1.6;

/** Millimeters first; then TUM's, RealSense's finest and L515's, centimeters, KITTI's, and 10 m on
 *  the whole range of 16 bits. */
constexpr double usual_units[] = {1000, 5000, 10000, 4000, 100, 256, 6553.5};

}  // namespace

void DepthHistogram::add(const cv::Mat& depth) {
    for (int v = 0; v < depth.rows; v += stride) {
        const auto* row = depth.ptr<std::uint16_t>(v);
        for (int u = 0; u < depth.cols; u += stride) {
            ++pixels_;
            if (row[u] == 0) continue;
            ++readings_;
            ++counts_[row[u]];
        }
    }
}

std::uint16_t DepthHistogram::quantile(double share) const {
    if (readings_ == 0) return 0;
    const auto wanted = static_cast<std::uint64_t>(
        std::max(1.0, std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(readings_))));
    std::uint64_t so_far = 0;
    for (std::size_t reading = 1; reading < counts_.size(); ++reading) {
        so_far += counts_[reading];
        if (so_far >= wanted) return static_cast<std::uint16_t>(reading);
    }
    return 65535;
}

double DepthHistogram::shareBeyond(double reading) const {
    if (readings_ == 0) return 0;
    std::uint64_t beyond = 0;
    for (std::size_t i = 1; i < counts_.size(); ++i) {
        if (static_cast<double>(i) > reading) beyond += counts_[i];
    }
    return static_cast<double>(beyond) / static_cast<double>(readings_);
}

DepthSummary summarize(const DepthHistogram& depth, double unit_m) {
    DepthSummary summary;
    if (depth.readings() == 0) return summary;
    summary.lower_quartile_m = depth.quantile(0.25) * unit_m;
    summary.median_m = depth.quantile(0.5) * unit_m;
    summary.upper_quartile_m = depth.quantile(0.75) * unit_m;
    summary.far_m = depth.quantile(0.95) * unit_m;
    summary.coverage = static_cast<double>(depth.readings()) / static_cast<double>(depth.pixels());
    summary.share_too_near = 1 - depth.shareBeyond(nearest_sensor_m / unit_m);
    summary.share_beyond = depth.shareBeyond(usual_max_depth_m / unit_m);
    return summary;
}

std::string toText(const DepthSummary& summary) {
    if (summary.coverage == 0) return "no pixel has a reading";
    char text[160];
    std::snprintf(text, sizeof text,
                  "median %.2f m, half of the readings from %.2f to %.2f m, %.0f %% of the pixels "
                  "have a reading",
                  summary.median_m, summary.lower_quartile_m, summary.upper_quartile_m,
                  100 * summary.coverage);
    return text;
}

bool isImplausible(const DepthSummary& summary) {
    return summary.coverage > 0 &&
           (summary.median_m < nearest_median_m || summary.median_m > farthest_median_m);
}

std::optional<double> plausibleDepthUnits(const DepthHistogram& depth, double units, bool assumed) {
    const DepthSummary summary = summarize(depth, 1 / units);
    const bool too_near = summary.share_too_near > share_in_doubt && summary.far_m < room_m;
    if (!isImplausible(summary) && !(assumed && too_near)) return std::nullopt;
    for (const double other : usual_units) {
        const double median_m = summary.median_m * units / other;
        const bool usual = median_m >= nearest_usual_m && median_m <= farthest_usual_m;
        if (std::abs(other - units) > 1e-6 * units && usual) return other;
    }
    return std::nullopt;
}

std::optional<double> betterMaxDepth(const DepthSummary& summary) {
    if (summary.share_beyond <= 0.5) return std::nullopt;
    const double step = std::pow(10, std::floor(std::log10(summary.far_m)) - 1);
    return step * std::ceil(summary.far_m / step);
}

}  // namespace rgbd_graphslam
