/** map.sparse: what a later run localizes in or goes on with. */
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rgbd_graphslam/slam/map_snapshot.h"

namespace rgbd_graphslam {

/** Of a map.sparse as it is written, and the oldest that is still read. */
constexpr std::uint32_t sparse_map_version = 3, oldest_sparse_map_version = 2;

/** Of the file in a run's output folder. */
inline constexpr const char* sparse_map_name = "map.sparse";

/** A rawlog that keyframes of a map come from. */
struct MapSession {
    std::string rawlog;  // absolute path
    int first_keyframe = 0;
    /** Of its camera; empty = that of the first frame. */
    std::string sensor_label = {};
};

void encode(const std::vector<MapSession>& sessions, ByteWriter& out);
/** \throws DamagedBytes */
std::vector<MapSession> decodeSessions(ByteReader& in);
/** \param keyframes of the map
 *  \throws DamagedBytes where sessions are not in order, or begin after the last keyframe */
void requireInOrder(const std::vector<MapSession>& sessions, std::size_t keyframes);

/** The contents of a map.sparse file. */
struct SparseMap {
    MapSnapshot snapshot;
    /** From the map's own world to the upright one of the run's output. */
    SE3 T_up_world;
    /** Of the run that wrote it, see configHash. */
    std::string config_hash;
    /** In order of time. */
    std::vector<MapSession> sessions;
};

/** Format: doc/file-formats.md. \throws Error when the file cannot be written */
void writeSparseMap(const std::string& path, const SparseMap& map);

/** \throws Error in one line naming the file when it is missing, not a map, of another version, cut
 *          off or damaged */
SparseMap readSparseMap(const std::string& path);

}  // namespace rgbd_graphslam
