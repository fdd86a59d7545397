/** Kernels that limit the influence of outliers on a least-squares solution. */
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

/** Cauchy's kernel: logarithmic, so that a far residual still pulls a little.
 *  \param limit of chi2 at which half the weight is left */
inline RobustCost cauchy(double chi2, double limit) {
    return {limit * std::log1p(chi2 / limit), 1 / (1 + chi2 / limit)};
}

/** Geman and McClure's kernel, whose cost never exceeds the limit: far outliers have no say.
 *  \param limit of chi2 at which half the cost and a quarter of the weight are left */
inline RobustCost gemanMcClure(double chi2, double limit) {
    const double share = limit / (limit + chi2);
    return {chi2 * share, share * share};
}

/** Huber's weight c / r beyond the limit c of a residual r draws a solution from afar; Geman and
 *  McClure's (c^2 / (c^2 + r^2))^2 needs a good start, and keeps the solution there though a third
 *  of the measurements agree on another. */
enum class KernelShape { None, Huber, Cauchy, GemanMcClure };

/** A kernel and where it begins to doubt. */
struct RobustKernel {
    KernelShape shape = KernelShape::None;
    /** Of chi2; unused by None. */
    double limit = 1;

    RobustCost operator()(double chi2) const {
        switch (shape) {
            case KernelShape::Huber:
                return huber(chi2, limit);
            case KernelShape::Cauchy:
                return cauchy(chi2, limit);
            case KernelShape::GemanMcClure:
                return gemanMcClure(chi2, limit);
            case KernelShape::None:
                break;
        }
        return {chi2, 1};
    }
};

}  // namespace rgbd_graphslam
