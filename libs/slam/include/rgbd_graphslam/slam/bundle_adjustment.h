/** Poses of several cameras and the points they see, together. */
#pragma once
#include <vector>

#include "rgbd_graphslam/slam/reprojection.h"

namespace rgbd_graphslam {

struct BundleObservation {
    int camera = 0, point = 0;
    Measurement measurement;
    /** Set by the solver: does not fit and was left out. */
    bool outlier = false;
};

/** Cameras [0, free_cameras) are moved, the rest hold the problem in place. Observations are sorted
 *  by point. */
struct BundleProblem {
    Camera camera;
    std::vector<SE3> T_cam_world;
    int free_cameras = 0;
    std::vector<Eigen::Vector3d> points;  // world, m
    std::vector<BundleObservation> observations;
};

struct BundleSummary {
    double initial_cost = 0, final_cost = 0;
    int iterations = 0;
};

/** Half the Huber cost that adjustBundle minimizes, over observations that are no outliers. */
double bundleCost(const BundleProblem& problem);

/** Marks the observations beyond 95 % of chi-square, and unmarks the others. */
void markBundleOutliers(BundleProblem& problem);

/** Minimizes the Huber cost of the whitened residuals by Levenberg-Marquardt with the points
 *  eliminated first (Schur complement; Triggs et al., "Bundle adjustment - a modern synthesis",
 *  2000). Half way, observations beyond 95 % of chi-square are marked as outliers and left out.
 *  Dense in the cameras: meant for tens of free ones.
 *  \param mark_outliers false keeps every observation */
BundleSummary adjustBundle(BundleProblem& problem, int max_iterations, bool mark_outliers = true);

}  // namespace rgbd_graphslam
