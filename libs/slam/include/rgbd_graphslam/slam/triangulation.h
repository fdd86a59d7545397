/** Points from two views, for keypoints whose depth the sensor could not read. */
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/reprojection.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** Two keypoints of two keyframes and the point that they show. */
struct TriangulatedPoint {
    int keypoint_a = 0, keypoint_b = 0;
    Eigen::Vector3d position;  // world, m
};

/** Position that two rays agree on best: the midpoint of their shortest connection weighted by
 *  distance, i.e. the linear solution of Hartley and Sturm, "Triangulation", CVIU 1997.
 *  \param camera_a, camera_b rectified; \param a, b their pixels; \param T_a_world, T_b_world poses
 * of the cameras \return world, m; nothing when the rays are almost parallel or meet behind a
 * camera */
std::optional<Eigen::Vector3d> triangulate(const CameraModel& camera_a, const CameraModel& camera_b,
                                           const SE3& T_a_world, const SE3& T_b_world,
                                           const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/** Matches keypoints of two keyframes that neither have depth nor show a landmark, along their
 *  epipolar lines, and triangulates them. Points that do not fit both keyframes are left out. */
std::vector<TriangulatedPoint> triangulateBetween(const RigCameras& cameras, const SlamMap& map,
                                                  const SlamOptions& options, int keyframe_a,
                                                  int keyframe_b);

}  // namespace rgbd_graphslam
