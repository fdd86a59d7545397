/** A map taken out of a run, to be kept and gone on with. */
#pragma once
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

/** Keyframes, landmarks and loops of a map, and the camera they belong to. */
struct MapSnapshot {
    /** That took the keyframes. */
    Rig rig;
    double scale_factor = 1;
    int levels = 1;
    std::vector<Keyframe> keyframes;
    /** Living ones only. */
    std::vector<Landmark> landmarks;
    std::vector<PoseEdge> loops;
};

/** \param map is copied; dead landmarks are left out and the others numbered anew in their order */
MapSnapshot takeSnapshot(const SlamMap& map, const Rig& rig, double scale_factor,
                         std::vector<PoseEdge> loops);

void encode(const MapSnapshot& snapshot, ByteWriter& out);

/** \throws DamagedBytes when the bytes end early, a number is not finite, an index names nothing,
 * or the two directions of the observations cannot agree */
MapSnapshot decodeSnapshot(ByteReader& in);

}  // namespace rgbd_graphslam
