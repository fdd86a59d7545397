#include "rgbd_graphslam/metrics/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

double meanSquareAbout(double center, const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += (value - center) * (value - center);
    return sum / values.size();
}

}  // namespace

Statistics statisticsOf(const std::vector<double>& values) {
    Statistics s;
    s.count = values.size();
    if (values.empty()) return s;
    s.mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
    s.rmse = std::sqrt(meanSquareAbout(0, values));
    s.std = std::sqrt(meanSquareAbout(s.mean, values));
    s.median = percentileOf(values, 0.5);
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    s.min = *min;
    s.max = *max;
    return s;
}

double percentileOf(std::vector<double> values, double share) {
    if (values.empty()) throw Error("no values to take a percentile of");
    std::sort(values.begin(), values.end());
    const double rank = share * (values.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const auto above = std::min(below + 1, values.size() - 1);
    return values[below] + (rank - below) * (values[above] - values[below]);
}

}  // namespace rgbd_graphslam
