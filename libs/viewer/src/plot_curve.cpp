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

}  // namespace rgbd_graphslam
