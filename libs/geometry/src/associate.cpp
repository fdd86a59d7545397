#include "rgbd_graphslam/geometry/associate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace rgbd_graphslam {
namespace {

/** Positions are ranks in time order. */
struct Candidate {
    double difference;
    std::size_t rank_a, rank_b;

    bool operator<(const Candidate& other) const {
        return std::tie(difference, rank_a, rank_b) <
               std::tie(other.difference, other.rank_a, other.rank_b);
    }
};

std::vector<std::size_t> finiteInTimeOrder(const std::vector<double>& stamps) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        if (std::isfinite(stamps[i])) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return stamps[i] < stamps[j]; });
    return order;
}

std::vector<double> picked(const std::vector<double>& stamps, const std::vector<std::size_t>& order,
                           double offset) {
    std::vector<double> result;
    result.reserve(order.size());
    for (const std::size_t i : order) result.push_back(stamps[i] + offset);
    return result;
}

/** All pairs closer than max_difference of two ascending lists. */
std::vector<Candidate> candidates(const std::vector<double>& a, const std::vector<double>& b,
                                  double max_difference) {
    std::vector<Candidate> found;
    std::size_t first = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        while (first < b.size() && a[i] - b[first] >= max_difference) ++first;
        for (std::size_t j = first; j < b.size() && b[j] - a[i] < max_difference; ++j) {
            found.push_back({std::abs(a[i] - b[j]), i, j});
        }
    }
    return found;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<double>& a,
                                                           const std::vector<double>& b,
                                                           double max_difference, double offset) {
    const auto order_a = finiteInTimeOrder(a), order_b = finiteInTimeOrder(b);
    auto closest_first =
        candidates(picked(a, order_a, 0), picked(b, order_b, offset), max_difference);
    std::sort(closest_first.begin(), closest_first.end());

    constexpr std::size_t none = -1;
    std::vector<std::size_t> partner(order_a.size(), none);
    std::vector<bool> taken(order_b.size(), false);
    for (const auto& [difference, i, j] : closest_first) {
        if (partner[i] != none || taken[j]) continue;
        partner[i] = j;
        taken[j] = true;
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < partner.size(); ++i) {
        if (partner[i] != none) pairs.emplace_back(order_a[i], order_b[partner[i]]);
    }
    return pairs;
}

}  // namespace rgbd_graphslam
