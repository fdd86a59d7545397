/** Planar measurements as edges of the pose graph. */
#pragma once
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/laser/planar_scan.h"

namespace rgbd_graphslam {

/** \param information of (x, y, yaw) in the frame of `to`; height, roll and pitch are held level */
inline PoseEdge planarEdge(int from, int to, const PlanarPose& T_from_to,
                           const Eigen::Matrix3d& information, EdgeKind kind, int inliers) {
    constexpr double level = 1e6, least = 1e-3;  // 1 mm, 1 mrad; positive definite
    Matrix6d all = Matrix6d::Identity() * level;
    const int rows[] = {0, 1, 5};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) all(rows[i], rows[j]) = information(i, j);
        all(rows[i], rows[i]) += least;
    }
    return {from, to, toSE3(T_from_to), all, kind, inliers};
}

inline PlanarPose toPlanar(const SE3& pose) {
    return {pose.t.x(), pose.t.y(), std::atan2(pose.R(1, 0), pose.R(0, 0))};
}

}  // namespace rgbd_graphslam
