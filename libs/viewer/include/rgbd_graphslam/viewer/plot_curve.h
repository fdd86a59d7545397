/** Curves that are longer than a plot is wide. */
#pragma once
#include <cstddef>
#include <vector>

namespace rgbd_graphslam {

/** Values evenly over a width: the extremes of every stretch in their order, and a gap in every
 *  stretch that has one.
 *  \param values NaN is a gap
 *  \param most of the result; 2 at least
 *  \return the values where they are not more than that */
std::vector<float> thinnedCurve(const std::vector<float>& values, std::size_t most);

}  // namespace rgbd_graphslam
