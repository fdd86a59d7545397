#include "rgbd_graphslam/viewer/plot_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rgbd_graphslam {
namespace {

using Iterator = std::vector<float>::const_iterator;

/** Two values that stand for some. */
void addExtremes(Iterator begin, Iterator end, std::vector<float>& thinned) {
    const auto is_gap = [](float value) { return std::isnan(value); };
    const auto lower = [&](float a, float b) { return is_gap(b) ? !is_gap(a) : a < b; };
    const Iterator low = std::min_element(begin, end, lower);
    if (std::any_of(begin, end, is_gap)) {
        thinned.insert(thinned.end(), {*low, std::numeric_limits<float>::quiet_NaN()});
        return;
    }
    const Iterator high = std::max_element(begin, end);
    thinned.insert(thinned.end(), {*std::min(low, high), *std::max(low, high)});
}

}  // namespace

std::vector<float> thinnedCurve(const std::vector<float>& values, std::size_t most) {
    if (values.size() <= most) return values;
    const std::size_t stretches = std::max<std::size_t>(most / 2, 1);
    std::vector<float> thinned;
    for (std::size_t i = 0; i < stretches; ++i) {
        const auto at = [&](std::size_t stretch) {
            return values.begin() +
                   static_cast<std::ptrdiff_t>(stretch * values.size() / stretches);
        };
        addExtremes(at(i), at(i + 1), thinned);
    }
    return thinned;
}

float axisEnd(std::vector<float> values) {
    constexpr double usual_share = 0.99;
    constexpr float room = 1.5f;
    values.erase(
        std::remove_if(values.begin(), values.end(), [](float v) { return std::isnan(v); }),
        values.end());
    if (values.empty()) return 0;
    const float highest = *std::max_element(values.begin(), values.end());
    const auto usual = values.begin() + static_cast<std::ptrdiff_t>(
                                            usual_share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), usual, values.end());
    return *usual > 0 ? std::min(highest, room * *usual) : highest;
}

}  // namespace rgbd_graphslam
