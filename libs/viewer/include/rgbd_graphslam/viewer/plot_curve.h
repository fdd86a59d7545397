/** Curves of any length and height in a small plot. */
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

/** Where a plot's axis ends: at the highest value, but one that stands far out of 99 % of them does
 *  not press the others to the ground.
 *  \param values NaN is a gap
 *  \return 0 where there are none */
float axisEnd(std::vector<float> values);

}  // namespace rgbd_graphslam
