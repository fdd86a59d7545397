/** Keyframes and the points they see, estimated together. */
#pragma once
#include <memory>
#include <vector>

#include "rgbd_graphslam/estimation/factor.h"
#include "rgbd_graphslam/estimation/reprojection.h"

namespace rgbd_graphslam {

/** A point seen by a camera. */
struct BundleObservation {
    int keyframe = 0, point = 0;
    Measurement measurement;
    /** Index in BundleProblem::cameras. */
    int camera = 0;
    /** Set by the solver: does not fit and was left out. */
    bool outlier = false;
};

/** Keyframes [0, free_keyframes) are moved, the rest hold the problem in place. Observations are
 *  sorted by point. Motion states are unknowns where a factor names them. */
struct BundleProblem {
    /** On the body of every keyframe. */
    std::vector<MountedCamera> cameras{MountedCamera()};
    States states;
    int free_keyframes = 0;
    std::vector<BundleObservation> observations;
    /** Any other measurements. */
    std::vector<std::shared_ptr<const Factor>> factors;
};

/** What an adjustment achieved. */
struct BundleSummary {
    double initial_cost = 0, final_cost = 0;
    int iterations = 0;
};

/** Half the robust cost that adjustBundle minimizes, over observations that are no outliers and all
 *  factors where they are defined. */
double bundleCost(const BundleProblem& problem);

/** Marks the observations beyond 95 % of chi-square, and unmarks the others. */
void markBundleOutliers(BundleProblem& problem);

/** Minimizes the robust cost of the whitened residuals by Levenberg-Marquardt with the points
 *  eliminated first (Schur complement; Triggs et al., "Bundle adjustment - a modern synthesis",
 *  2000). Half way, observations beyond 95 % of chi-square are marked as outliers and left out.
 *  Dense in the keyframes: meant for tens of free ones.
 *  \param mark_outliers false keeps every observation
 *  \throws Error when a factor names a point: points have observations only */
BundleSummary adjustBundle(BundleProblem& problem, int max_iterations, bool mark_outliers = true);

}  // namespace rgbd_graphslam
