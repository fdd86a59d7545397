/** Pose of one camera against known points. */
#pragma once
#include <vector>

#include "rgbd_graphslam/slam/reprojection.h"

namespace rgbd_graphslam {

/** A known point and how the camera sees it. */
struct PointMatch {
    Eigen::Vector3d position;  // world, m
    Measurement measurement;
    /** Weight of the match besides its noise, 0 to 1: how sure it is that the point stands still.
     */
    double trust = 1;
};

struct PoseSolution {
    SE3 T_cam_world;
    /** One a match. */
    std::vector<bool> inlier;
    int inliers = 0;
    /** Inverse covariance of the pose's left perturbation (m, rad in the camera frame), were every
     *  match as sure as its trust: less of it than noise alone would give. */
    Matrix6d information = Matrix6d::Zero();
};

/** How little a match counts whose residual r is beyond the limit c of chi: Huber's c / r draws the
 *  pose from afar; Geman and McClure's (c^2 / (c^2 + r^2))^2 needs a good initial pose and leaves
 *  it where it is though a third of the matches, all together, moves otherwise. */
enum class PoseKernel { Huber, GemanMcClure };

/** Minimizes the robust cost of the whitened residuals over the pose by Gauss-Newton with
 *  Levenberg's damping, drops the matches beyond 95 % of chi-square, and minimizes the Huber cost
 *  of the others.
 *
 *  \param initial T_cam_world to start from
 *
 *  \param kernel of the first minimization */
PoseSolution solvePose(const Camera& camera, const std::vector<PointMatch>& matches,
                       const SE3& initial, PoseKernel kernel = PoseKernel::Huber);

}  // namespace rgbd_graphslam
