/** How well an octree tells surface from free space. */
#pragma once
#include <optional>
#include <string>

#include "rgbd_graphslam/evaluation/commands.h"
#include "rgbd_graphslam/evaluation/surface_sight.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/metrics/alignment.h"

namespace octomap {
class OcTree;
}

namespace rgbd_graphslam {

/** Of the surface that a camera saw, by area: a voxel that the surface merely clips counts as
 * little as it holds. */
struct SeenSurface {
    double area_m2 = 0;
    double occupied = 0;                   // share of it in occupied voxels
    double occupied_within_tolerance = 0;  // share with an occupied voxel within tolerance
    double free = 0;                       // share in free voxels; the rest is in unknown ones
};

/** Of the voxels that the octree knows as occupied or free; the others were not seen. */
struct OctreeAccuracy {
    std::size_t surface_voxels = 0;  // known voxels with true surface inside
    double surface_occupied = 0;     // share of them that are occupied
    /** The same, where an occupied voxel within tolerance_m of the surface counts as well: a wall
     *  in the boundary of two voxels is in one of them by chance. */
    double surface_occupied_within_tolerance = 0;
    std::size_t free_voxels = 0;      // known voxels without surface within tolerance_m
    double free_occupied = 0;         // share of them that are occupied
    std::optional<SeenSurface> seen;  // nothing when it is not told what was seen
};

/** \param surface triangles or dense points
 *  \param truth_from_map moves the map onto the surface
 *  \param tolerance_m noise of depth that counts as the surface's place
 *  \param sight tells what the camera saw of the surface; may be null */
OctreeAccuracy evaluateOctree(const octomap::OcTree& tree, const PlyModel& surface,
                              const Similarity& truth_from_map, double tolerance_m,
                              const SurfaceSight* sight = nullptr);

/** The map is a .bt. */
struct OctreeRequest : SurfaceRequest {
    double tolerance_m = 0.02;
};
/** \return the table to print \throws Error for what cannot be read */
std::string runOctreeEvaluation(const OctreeRequest& request);

}  // namespace rgbd_graphslam
