/** Readings of a sensor between two moments. */
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

namespace rgbd_graphslam {

/** The samples from one moment to another, with interpolated ones at both ends.
 *  \param samples with a `stamp_s`, by rising stamp
 *  \param interpolate (a, b, stamp_s) gives the sample at a stamp between those of a and b
 *  \return nothing where the samples do not reach both ends, repeat or go back in time, or leave a
 *          gap longer than `longest_gap_s` */
template <class Sample, class Interpolate>
std::optional<std::vector<Sample>> samplesBetween(const std::vector<Sample>& samples, double from_s,
                                                  double to_s, double longest_gap_s,
                                                  Interpolate interpolate) {
    const auto later = [](double stamp_s, const Sample& s) { return stamp_s < s.stamp_s; };
    const auto sooner = [](const Sample& s, double stamp_s) { return s.stamp_s < stamp_s; };
    const auto first = std::upper_bound(samples.begin(), samples.end(), from_s, later);
    const auto last = std::lower_bound(samples.begin(), samples.end(), to_s, sooner);
    if (first == samples.begin() || last == samples.end() || !(from_s < to_s)) return std::nullopt;
    for (auto s = first; s != last + 1; ++s) {
        const double gap_s = s->stamp_s - (s - 1)->stamp_s;
        if (!(gap_s > 0 && gap_s <= longest_gap_s)) return std::nullopt;
    }
    std::vector<Sample> between{interpolate(*(first - 1), *first, from_s)};
    between.insert(between.end(), first, last);
    between.push_back(interpolate(*(last - 1), *last, to_s));
    return between;
}

}  // namespace rgbd_graphslam
