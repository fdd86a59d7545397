/** The run's contents as lines and triangles. All are in world coordinates, in m. */
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/view_scale.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Two vertices a line: n - 1 lines for n poses.
 *  \param unplaced_s stamps of frames without a pose, rising; a line across one has no length */
Vertices pathLines(const Trajectory& poses, const std::vector<double>& unplaced_s,
                   const Rgba& color);

/** Vertices of one frustum: lines from the eye to the corners, and round the picture. */
inline constexpr std::size_t vertices_a_frustum = 16;
Vertices frustumLines(const Trajectory& cameras, const Camera& camera, double depth_m,
                      const Rgba& color);

/** A line an edge. */
Vertices edgeLines(const Trajectory& keyframes, const std::vector<KeyframeEdge>& edges,
                   const Rgba& color);

/** A line a pair. */
Vertices pairLines(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs,
                   const Rgba& color);

Vertices floorLines(const FloorGrid& grid, const Rgba& color);

/** The sides of an octree's cells that other cells do not cover whole, as triangles; one list a
 *  direction: -x, +x, -y, +y, -z, +z. */
std::array<Vertices, 6> outerFaces(const std::vector<OctreeCell>& cells);

/** Obstacles and free cells as triangles a little above the floor; unseen cells are left open. */
Vertices gridTriangles(const GridMap& grid);

Vertices pointVertices(const PointMap& points);

/** Vertices of a mesh, with the light that falls on them as alpha: from above and a little aside,
 *  mild enough to leave the colors as they are. Gray where the mesh has no colors. */
Vertices meshVertices(const PlyModel& mesh);

/** A mesh to be drawn fast, of the same vertices: of those in a cube one stands for all, which
 * leaves larger triangles (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering
 * complex scenes", 1993). The cubes are as large as it takes. \param most how many triangles; a
 * mesh that has no more stays as it is */
Triangles fewerTriangles(const PlyModel& mesh, std::size_t most);

}  // namespace rgbd_graphslam
