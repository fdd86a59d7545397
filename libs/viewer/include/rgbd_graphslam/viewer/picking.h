/** What the mouse points at. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/orbit_camera.h"

namespace rgbd_graphslam {

/** The keyframe whose eye is drawn nearest to a pixel, among the first `count`.
 *  \return nothing when none is within `radius_px` */
std::optional<std::size_t> keyframeAt(const Trajectory& keyframes, std::size_t count,
                                      const Eigen::Vector2d& pixel, const OrbitCamera& camera,
                                      const Eigen::Vector2i& size_px, double radius_px = 14);

/** The surface nearest to a pixel.
 *  \param depths around `pixel` as OpenGL's depth buffer holds them, row 0 at the top; an odd
 *         number of rows and columns
 *  \return world point (m), or nothing where only background is */
std::optional<Eigen::Vector3d> surfaceAt(const cv::Mat1f& depths, const Eigen::Vector2i& pixel,
                                         const OrbitCamera& camera, const Eigen::Vector2i& size_px);

}  // namespace rgbd_graphslam
