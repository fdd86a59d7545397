/** Rigid motion between two sets of matched points, many of them wrong. */
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "rgbd_graphslam/estimation/pose_solver.h"
#include "rgbd_graphslam/slam/rig_cameras.h"

namespace rgbd_graphslam {

/** A motion and the matches that agree with it. */
struct RansacAlignment {
    SE3 T_cam_world;
    std::vector<bool> inlier;
    int inliers = 0;
};

/** Samples three pairs at a time (Fischler and Bolles, 1981), aligns them (Umeyama, PAMI 1991) and
 *  keeps the motion whose reprojections fit most matches. Stops early once a better one is
 * improbable. \param points_cam matched points in camera coordinates, one a match, m \param
 * max_iterations of sampling; \param seed of the sampling \return nothing with fewer than three
 * matches or no sample that fits */
std::optional<RansacAlignment> alignRobustly(const RigCameras& cameras,
                                             const std::vector<PointMatch>& matches,
                                             const std::vector<Eigen::Vector3d>& points_cam,
                                             int max_iterations, std::uint64_t seed);

}  // namespace rgbd_graphslam
