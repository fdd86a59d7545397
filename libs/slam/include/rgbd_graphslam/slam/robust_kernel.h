/** Kernels that keep outliers from ruling a least-squares solution. */
#pragma once
#include <cmath>

namespace rgbd_graphslam {

/** What a kernel makes of a squared whitened residual (chi2): the cost, which equals chi2 for small
 *  ones, and its derivative by chi2, the weight in reweighted least squares. */
struct RobustCost {
    double cost, weight;
};

/** Huber's kernel: linear in the residual beyond the limit (Huber, "Robust estimation of a location
 *  parameter", 1964). \param limit of chi2, positive */
inline RobustCost huber(double chi2, double limit) {
    if (chi2 <= limit) return {chi2, 1};
    const double delta = std::sqrt(limit), r = std::sqrt(chi2);
    return {2 * delta * r - limit, delta / r};
}

/** Geman and McClure's kernel, whose cost never exceeds the limit: far outliers have no say.
 *  \param limit of chi2 at which half the cost and a quarter of the weight are left */
inline RobustCost gemanMcClure(double chi2, double limit) {
    const double share = limit / (limit + chi2);
    return {chi2 * share, share * share};
}

}  // namespace rgbd_graphslam
