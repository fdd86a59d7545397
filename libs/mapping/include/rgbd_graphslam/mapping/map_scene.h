/** The map as a 3-D scene. */
#pragma once
#include <mrpt/opengl/COpenGLScene.h>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** Names of the scene's objects, by which a viewer finds them. */
namespace scene_names {
inline constexpr const char* points = "points";
inline constexpr const char* floor = "floor";
inline constexpr const char* trajectory = "trajectory";
inline constexpr const char* keyframes = "keyframes";
inline constexpr const char* loops = "loops";
inline constexpr const char* loop_inliers = "loop inliers";
inline constexpr const char* graph_before_loops = "graph before loops";
}  // namespace scene_names

/** Colored points, floor grid, trajectory, keyframes as view frustums, loop edges with the
 * number of their inliers, and the graph as it was before loops. \param inputs upright \param
 * camera gives the frustums their shape */
mrpt::opengl::COpenGLScene makeScene(const MapInputs& inputs, const PointMap& points,
                                     const Camera& camera);

}  // namespace rgbd_graphslam
