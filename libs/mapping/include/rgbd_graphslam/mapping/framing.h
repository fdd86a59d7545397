/** What of a map a picture has to show. */
#pragma once
#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** Most of what the cameras looked at. */
struct Framing {
    /** From the 2nd to the 98th percentile along each axis; empty when there is neither a point
     *  nor a pose. */
    Eigen::AlignedBox3d box;
    /** Some of the points and of the path within it, for OrbitCamera::frame(). */
    std::vector<Eigen::Vector3d> points;
};

/** Percentiles are of points weighted by how many readings of the keyframes they stand for (the
 *  number of views, less for far ones), and of the path. A few stray points or a wall seen once
 *  through an open door would make the rest of the map small.
 *  \param points world, m; of many an even selection is used
 *  \param highest_m points above it are not shown and do not count */
Framing framingOf(const PointMap& points, const Trajectory& keyframes, const Trajectory& path,
                  double highest_m = std::numeric_limits<double>::infinity());

/** Where pictures cut the ceiling off, so that rooms can be looked into: above people's heads and
 *  above the camera. */
double ceilingCut(const Trajectory& path, double lowest_m = 2);

/** ceilingCut() of the trajectory; infinite where up is a guess. */
double pictureCeiling(const MapInputs& inputs);

/** Keyframes to draw so that their frustums do not cover one another and the map: each differs from
 *  all that are kept before it by a distance or by its direction of view. Rising indices.
 *  \param least_m distance, \param least_rad angle between the directions of view */
std::vector<std::size_t> sparseKeyframes(const Trajectory& keyframes, double least_m,
                                         double least_rad = 0.35);

/** How far from each other keyframes are in general, within bounds that suit the size of a frustum:
 *  its depth, m. */
double frustumDepth(const Trajectory& keyframes);

}  // namespace rgbd_graphslam
