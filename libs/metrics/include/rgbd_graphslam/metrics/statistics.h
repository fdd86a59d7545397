/** What is said about a set of errors. */
#pragma once
#include <cstddef>
#include <vector>

namespace rgbd_graphslam {

/** In the unit of the values; `std` is that of the population, as the TUM tools print it. */
struct Statistics {
    std::size_t count = 0;
    double rmse = 0, mean = 0, median = 0, std = 0, min = 0, max = 0;
};

/** All zero for no values. */
Statistics statisticsOf(const std::vector<double>& values);

/** The value below which `share` in [0, 1] of the values lie, linear between neighbors; the median
 *  is percentileOf(values, 0.5).
 *  \throws Error for no values */
double percentileOf(std::vector<double> values, double share);

}  // namespace rgbd_graphslam
