/** How well a map of points covers the true surface. */
#pragma once
#include <cstddef>
#include <optional>

#include "rgbd_graphslam/evaluation/mover_boxes.h"
#include "rgbd_graphslam/evaluation/surface_sight.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/metrics/alignment.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {

/** Where the map lies on the surface, and how completeness is counted. */
struct MapAccuracyOptions {
    /** Maps the map's coordinates to the surface's. */
    Similarity alignment;
    double completeness_distance_m = 0.02;
    /** The surface's triangles are sampled no coarser than this for the completeness. */
    double sample_spacing_m = 0.01;
    /** Points of the map farther from the surface than this show what is not there. */
    double beyond_m = 0.1;
    /** Tells what the camera saw of the surface; may be null. */
    const SurfaceSight* sight = nullptr;
    /** Where things moved, in the surface's frame; may be null. */
    const MoverWays* movers = nullptr;
};

/** Distances from map to surface and the share of the surface that is covered. */
struct MapAccuracy {
    /** Of the map's points to the surface; exact for triangles, to the nearest vertex for a surface
     *  given as points. */
    Statistics distance_m;
    double distance_95_m = 0;  // 95 % of the points are nearer
    /** Share of the points that are farther than beyond_m. */
    double beyond = 0;
    /** Share of the points that are so and where a mover has been; nothing when it is not told. */
    std::optional<double> on_movers_ways;
    /** Share of the surface, seen or not, by area (by number for a surface given as points),
     *  that has a point of the map within the completeness distance. */
    double completeness = 0;
    /** The same of what the camera saw; nothing when it is not told what that is. */
    std::optional<double> completeness_of_seen;
    std::size_t surface_samples = 0;
};

/** Accuracy and completeness in the sense of Seitz et al., "A comparison and evaluation of
 *  multi-view stereo reconstruction algorithms", CVPR 2006.
 *  \param surface triangles, or points that sample it densely
 *  \throws Error for an option that is not positive a map without points, or a surface too large to
 *          be one in meters */
MapAccuracy evaluateMap(const PlyModel& map, const PlyModel& surface,
                        const MapAccuracyOptions& options = {});

}  // namespace rgbd_graphslam
