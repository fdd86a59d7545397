/** Which entry of one stamped list belongs to which of another. */
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace rgbd_graphslam {

/** One-to-one association by nearest stamp, the rule of the TUM RGB-D benchmark's tools (Sturm et
 *  al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012): of all pairs closer
 * than `max_difference` the closest is taken first, then the closest of what is left, and so on;
 * equal differences are settled in favour of the earlier `a`, then the earlier `b`. \param a, b
 * stamps in seconds, in any order; entries that are not finite find no partner \param
 * max_difference in seconds, exclusive \param offset in seconds, added to every stamp of `b`
 *  \return pairs (index into a, index into b) in time order of `a` */
std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<double>& a,
                                                           const std::vector<double>& b,
                                                           double max_difference,
                                                           double offset = 0);

}  // namespace rgbd_graphslam
