/** The pieces of a map as bytes, for map.sparse and checkpoints. Reading throws DamagedBytes where
 *  the bytes end early, a number is not finite or an index names nothing. */
#pragma once
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

constexpr int most_levels = 32;

// Sizes on disk, for checking counts before anything is allocated.
constexpr std::size_t camera_bytes = 2 * sizeof(std::int32_t) + 16 * sizeof(double);
constexpr std::size_t keypoint_bytes = 4 * sizeof(float) + 3 + sizeof(Descriptor);
constexpr std::size_t pose_bytes = 12 * sizeof(double);
constexpr std::size_t keyframe_bytes = sizeof(double) + 2 * 4 + pose_bytes + 2;
constexpr std::size_t landmark_bytes = 7 * sizeof(double) + sizeof(Descriptor) + 1 + 4 * 4;
constexpr std::size_t edge_bytes = pose_bytes + 21 * sizeof(double) + 3 * 4;

double getFinite(ByteReader& in);
/** \param magnitude greatest that is believed */
float getFloat(ByteReader& in, float magnitude);
/** \param what it counts, for the error
 *  \return an index in [0, end) */
int getIndex(ByteReader& in, std::size_t end, const char* what);
void putFlag(bool flag, ByteWriter& out);
bool getFlag(ByteReader& in);

/** Numbers of landmarks or keyframes. */
void putNumbers(const std::vector<int>& numbers, ByteWriter& out);
/** \return each in [0, end) */
std::vector<int> getNumbers(ByteReader& in, std::size_t end);
/** \param end of the landmarks
 *  \return each in [0, end) or no_landmark */
std::vector<int> getLandmarks(ByteReader& in, std::size_t end);
/** What is counted up, frame by frame.
 *  \return not negative, and far from overflowing */
int getTally(ByteReader& in);

/** A rotation matrix by rows, then the translation. */
void encodePose(const SE3& pose, ByteWriter& out);
/** \throws DamagedBytes when the bytes are no rigid motion */
SE3 decodePose(ByteReader& in);

void put(const DeadReckoning& reckoning, ByteWriter& out);
DeadReckoning getReckoning(ByteReader& in);

void put(const Descriptor& descriptor, ByteWriter& out);
Descriptor getDescriptor(ByteReader& in);

void put(const LandmarkPatch& seen, ByteWriter& out);
LandmarkPatch getPatch(ByteReader& in, int levels, int cameras);

void put(const Camera& camera, ByteWriter& out);
Camera getCamera(ByteReader& in);
void put(const Rig& rig, ByteWriter& out);
Rig getRig(ByteReader& in);

/** Stamp, keypoints and descriptors. */
void put(const Frame& frame, ByteWriter& out);
Frame getFrame(ByteReader& in, const RigCameras& cameras, int levels);

void put(Link link, ByteWriter& out);
Link getLink(ByteReader& in);

/** All but its landmarks, which name it themselves. */
void put(const Keyframe& keyframe, ByteWriter& out);
/** \param keyframes there are */
Keyframe getKeyframe(ByteReader& in, int id, std::size_t keyframes, const RigCameras& cameras,
                     int levels);
/** \throws DamagedBytes unless culled ones see nothing and are tied to living ones */
void checkCulled(const std::vector<Keyframe>& keyframes);

void put(const Landmark& landmark, ByteWriter& out);
/** Notes the observations at the keyframes, too. */
Landmark getLandmark(ByteReader& in, int id, std::vector<Keyframe>& keyframes, int levels,
                     int cameras);

/** All but its kind. */
void put(const PoseEdge& edge, ByteWriter& out);
PoseEdge getEdge(ByteReader& in, std::size_t keyframes, EdgeKind kind);

}  // namespace rgbd_graphslam
