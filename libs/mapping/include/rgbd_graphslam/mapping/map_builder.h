/** All map files of a finished run. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** A loop between two keyframes, by their index in MapInputs::keyframes. */
struct MapLoopEdge {
    int from = 0, to = 0;
    int inliers = 0;
};

/** A rawlog of an earlier session and how many keyframes are its. */
struct EarlierSession {
    std::string rawlog;
    std::size_t keyframes = 0;
};

/** What maps are made of. Poses are of the camera's optical frame. */
struct MapInputs {
    std::string rawlog;    // where the images are
    Trajectory keyframes;  // the maps are made of these; in order of time within a session
    /** Every frame; places depth images between colour stamps, and accelerometer readings. */
    Trajectory trajectory;
    std::vector<MapLoopEdge> loops;
    /** Keyframes as they were without loops; may be empty. */
    Trajectory keyframes_before_loops;
    /** Where the first keyframes come from; the rest is of `rawlog`. */
    std::vector<EarlierSession> earlier;
    /** Keyframes, by rising index, whose place relative to the others is unknown. */
    std::vector<int> apart;
};

/** T_up_world: z up, floor at z = 0, first camera above the origin and looking along +x. Up is
 * where the accelerometer says (specific force, averaged over the whole run in world axes), made
 * precise by the level surfaces in sight; else the normal of the floor; else the first camera's,
 * with a warning; see MapOptions::upright. \throws Error when the rawlog cannot be read or holds
 * none of the keyframes */
SE3 uprightFromWorld(const MapInputs& inputs, const MapOptions& options);

/** The inputs without the keyframes that are apart, the others counted anew. */
MapInputs withoutApart(const MapInputs& inputs);

/** All poses of the inputs in the frame a of T_a_world. */
MapInputs transformed(const SE3& T_a_world, MapInputs inputs);

struct MapSummary {
    std::size_t keyframes = 0, points = 0, octree_leaves = 0;
    int grid_width = 0, grid_height = 0;  // cells
    double insert_ms = 0;                 // a keyframe, all maps
    double megabytes = 0;                 // of the maps in memory
};

/** Writes points.ply, points.pcd, points.metricmap, octree.bt, octree.ot, grid.gridmap.gz,
 * grid.png, grid.yaml, map.simplemap, scene.3Dscene and map.png, in one pass over each rawlog. A
 * rawlog of an earlier session that is gone is warned of and left out.
 *  \param inputs upright: z up, floor at z = 0
 *  \throws Error when something cannot be read or written, or would not fit in memory */
MapSummary writeMaps(const MapInputs& inputs, const MapOptions& options,
                     const std::string& out_folder);

}  // namespace rgbd_graphslam
