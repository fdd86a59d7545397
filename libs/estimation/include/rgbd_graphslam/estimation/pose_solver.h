/** Pose of one keyframe or frame against known points. */
#pragma once
#include <vector>

#include "rgbd_graphslam/estimation/reprojection.h"
#include "rgbd_graphslam/estimation/robust_kernel.h"

namespace rgbd_graphslam {

/** A known point and how a camera sees it. */
struct PointMatch {
    Eigen::Vector3d position;  // world, m
    Measurement measurement;
    /** Weight of the match besides its noise, 0 to 1: how sure it is that the point stands still.
     */
    double trust = 1;
    /** Index in the cameras of solvePose. */
    int camera = 0;
};

/** A pose and the matches that agree with it. */
struct PoseSolution {
    SE3 T_body_world;
    /** One entry per match. */
    std::vector<bool> inlier;
    int inliers = 0;
    /** Inverse covariance of the pose's left perturbation (m, rad in the body frame), were every
     *  match as sure as its trust: less of it than noise alone would give. */
    Matrix6d information = Matrix6d::Zero();
};

/** Minimizes the robust cost of the whitened residuals over the pose by Gauss-Newton with
 *  Levenberg's damping, drops the matches beyond 95 % of chi-square, and minimizes the Huber cost
 *  of the others.
 *  \param cameras on the body, named by the matches
 *  \param initial T_body_world to start from
 *  \param kernel of the first minimization; its limit is the 95 % bound of each match */
PoseSolution solvePose(const std::vector<MountedCamera>& cameras,
                       const std::vector<PointMatch>& matches, const SE3& initial,
                       KernelShape kernel = KernelShape::Huber);

/** The same where one camera is the body. */
PoseSolution solvePose(const Camera& camera, const std::vector<PointMatch>& matches,
                       const SE3& initial, KernelShape kernel = KernelShape::Huber);

}  // namespace rgbd_graphslam
