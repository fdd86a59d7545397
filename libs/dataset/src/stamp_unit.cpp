#include "stamp_unit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rgbd_graphslam {
namespace {

constexpr double slowest_images_s = 4;
/** Readings beyond a recording's ends by this share of it still belong to it. */
constexpr double margin = 0.1;

/** Of the steps forward; 0 without any. */
double medianStep(const std::vector<double>& stamps) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < stamps.size(); ++i) {
        if (stamps[i] > stamps[i - 1]) steps.push_back(stamps[i] - stamps[i - 1]);
    }
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

double largest(const std::vector<double>& stamps) {
    double most = 0;
    for (const double stamp : stamps) most = std::max(most, std::abs(stamp));
    return most;
}

}  // namespace

const std::vector<StampUnit>& stampUnits() {
    static const std::vector<StampUnit> units = {
        {1, "seconds"}, {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}};
    return units;
}

StampUnit unitOfStamps(const std::vector<double>& stamps) {
    const auto& units = stampUnits();
    const double most = largest(stamps);
    if (most >= 1e17) return units[3];
    if (most >= 1e14) return units[2];
    if (most >= 1e11) return units[1];
    const double step = medianStep(stamps);
    const bool like_unix_seconds = most > 0.9e9 && most < 4.1e9;
    if (step < (like_unix_seconds ? 1000 : slowest_images_s)) return units[0];
    if (step < 1e3 * slowest_images_s) return units[1];
    if (step < 1e6 * slowest_images_s) return units[2];
    return units[3];
}

bool areFrameNumbers(const std::vector<double>& numbers) {
    constexpr double most_frames = 1e7, largest_stride = 1000;
    long long stride = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double number = numbers[i];
        if (number < 0 || number >= most_frames || number != std::floor(number)) return false;
        if (i > 0) stride = std::gcd(stride, std::llround(std::abs(number - numbers[i - 1])));
    }
    if (numbers.size() < 3) return true;
    const double step = medianStep(numbers);
    return step <= 2 || (static_cast<double>(stride) == step && step <= largest_stride);
}

std::optional<StampUnit> unitToOverlap(const std::vector<double>& stamps, double first_s,
                                       double last_s) {
    if (stamps.empty()) return std::nullopt;
    const auto [low, high] = std::minmax_element(stamps.begin(), stamps.end());
    const double slack_s = margin * (last_s - first_s);
    for (const StampUnit& unit : stampUnits()) {
        const double from_s = *low * unit.seconds, to_s = *high * unit.seconds;
        if (from_s <= last_s + slack_s && to_s >= first_s - slack_s) return unit;
    }
    return std::nullopt;
}

}  // namespace rgbd_graphslam
