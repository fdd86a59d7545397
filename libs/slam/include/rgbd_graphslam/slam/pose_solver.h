/** Pose of one camera against known points. */
#pragma once
#include <vector>

#include "rgbd_graphslam/slam/reprojection.h"

namespace rgbd_graphslam {

/** A known point and how the camera sees it. */
struct PointMatch {
    Eigen::Vector3d position;  // world, m
    Measurement measurement;
};

struct PoseSolution {
    SE3 T_cam_world;
    /** One a match. */
    std::vector<bool> inlier;
    int inliers = 0;
    /** Inverse covariance of the pose's left perturbation (m, rad in the camera frame). */
    Matrix6d information = Matrix6d::Zero();
};

/** Minimises the Huber cost of the whitened residuals over the pose by Gauss-Newton with
 *  Levenberg's damping, drops the matches beyond 95 % of chi-square, and minimises again.
 *  \param initial T_cam_world to start from */
PoseSolution solvePose(const Camera& camera, const std::vector<PointMatch>& matches,
                       const SE3& initial);

}  // namespace rgbd_graphslam
