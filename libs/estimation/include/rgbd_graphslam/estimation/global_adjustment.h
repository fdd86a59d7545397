/** Bundle adjustment of maps too large for dense normal equations. */
#pragma once
#include "rgbd_graphslam/estimation/bundle_adjustment.h"

namespace rgbd_graphslam {

/** Minimizes the same cost as adjustBundle by Ceres' sparse Schur solver, single-threaded and
 *  deterministic. Factors may name points. Outliers are marked after half of the iterations. */
BundleSummary adjustBundleSparse(BundleProblem& problem, int max_iterations,
                                 bool mark_outliers = true);

}  // namespace rgbd_graphslam
