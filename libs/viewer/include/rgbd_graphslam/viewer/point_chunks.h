/** Level of detail for large point clouds. */
#pragma once
#include <vector>

#include "rgbd_graphslam/mapping/orbit_camera.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Neighboring points in random order, so that the first n of them are an even thinning of all. */
struct PointChunk {
    std::size_t first = 0, count = 0;  // in ChunkedPoints::points
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius_m = 0;
};

/** Points sorted into chunks that are drawn or left out as a whole. */
struct ChunkedPoints {
    Vertices points;
    std::vector<PointChunk> chunks;
};

/** Sorts points along a space-filling curve (Morton order) and cuts it into chunks. The order
 *  within chunks comes from a fixed seed. */
ChunkedPoints chunked(Vertices points, std::size_t points_a_chunk = 16384);

/** Puts points in random order, from a fixed seed. */
void shufflePoints(Vertices& points);

/** The ball around points. \param first of them in the buffer they are drawn from */
PointChunk chunkOf(const Vertices& points, std::size_t first);

/** How many points of each chunk a view has use for: none where it is out of sight, and no more
 *  than a few a pixel where it is far. */
std::vector<std::size_t> usefulPoints(const std::vector<PointChunk>& chunks,
                                      const OrbitCamera& camera, const Eigen::Vector2i& size_px);

/** Points to draw one after the other. */
struct DrawRange {
    std::size_t first = 0, count = 0;
};

/** The part of every chunk's useful points between two shares of them, 0 to 1. Drawing [0, a) and
 *  then [a, 1) draws each point once. */
std::vector<DrawRange> slice(const std::vector<PointChunk>& chunks,
                             const std::vector<std::size_t>& useful, double from_share,
                             double to_share);

}  // namespace rgbd_graphslam
