#include "rgbd_graphslam/slam/map_snapshot.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr int most_levels = 32;
constexpr int largest_image_px = 1 << 16;
constexpr double least_orthonormal = 1e-6;

// Sizes on disk, for checking counts before anything is allocated.
constexpr std::size_t keypoint_bytes = 4 * sizeof(float) + 1 + sizeof(Descriptor);
constexpr std::size_t pose_bytes = 12 * sizeof(double);
constexpr std::size_t keyframe_bytes = sizeof(double) + 2 * 4 + pose_bytes + 2;
constexpr std::size_t landmark_bytes = 7 * sizeof(double) + sizeof(Descriptor) + 4 * 4;
constexpr std::size_t observation_bytes = 2 * sizeof(std::uint32_t);
constexpr std::size_t edge_bytes = pose_bytes + 21 * sizeof(double) + 3 * 4;

double getFinite(ByteReader& in) {
    const auto number = in.get<double>();
    if (!std::isfinite(number)) throw DamagedBytes("a number is not finite");
    return number;
}

float getFloat(ByteReader& in, float magnitude) {
    const auto number = in.get<float>();
    if (!(std::abs(number) <= magnitude)) throw DamagedBytes("a number is out of range");
    return number;
}

/** \return an index in [0, end) */
int getIndex(ByteReader& in, std::size_t end, const char* what) {
    const auto index = in.get<std::uint32_t>();
    if (index >= end) {
        throw DamagedBytes("a " + std::string(what) + " with number " + std::to_string(index) +
                           " of " + std::to_string(end));
    }
    return static_cast<int>(index);
}

void put(const Eigen::Vector3d& v, ByteWriter& out) {
    for (int i = 0; i < 3; ++i) out.put(v[i]);
}

Eigen::Vector3d getVector(ByteReader& in) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = getFinite(in);
    return v;
}

void put(const Descriptor& descriptor, ByteWriter& out) {
    for (const std::uint64_t word : descriptor) out.put(word);
}

Descriptor getDescriptor(ByteReader& in) {
    Descriptor descriptor;
    for (std::uint64_t& word : descriptor) word = in.get<std::uint64_t>();
    return descriptor;
}

void put(const Camera& camera, ByteWriter& out) {
    out.put<std::int32_t>(camera.width);
    out.put<std::int32_t>(camera.height);
    for (const double d : {camera.fx, camera.fy, camera.cx, camera.cy}) out.put(d);
    for (const double d : camera.distortion) out.put(d);
}

Camera getCamera(ByteReader& in) {
    Camera camera;
    for (int* side : {&camera.width, &camera.height}) {
        *side = in.get<std::int32_t>();
        if (*side < 1 || *side > largest_image_px)
            throw DamagedBytes("an image of impossible size");
    }
    for (double* d : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *d = getFinite(in);
    for (double& d : camera.distortion) d = getFinite(in);
    if (camera.fx <= 0 || camera.fy <= 0) throw DamagedBytes("a focal length that is not positive");
    return camera;
}

void put(const Frame& frame, ByteWriter& out) {
    out.put(frame.stamp_s);
    out.putCount(frame.keypoints.size());
    for (std::size_t i = 0; i < frame.keypoints.size(); ++i) {
        const Keypoint& k = frame.keypoints[i];
        for (const float f : {k.u, k.v, k.depth_m, k.angle_rad}) out.put(f);
        out.put(static_cast<std::uint8_t>(k.octave));
        put(frame.descriptors[i], out);
    }
}

Frame getFrame(ByteReader& in, const Camera& camera, int levels) {
    constexpr float farthest_m = 1e4f, two_turns_rad = 13;
    Frame frame;
    frame.stamp_s = getFinite(in);
    frame.keypoints.resize(in.getCount(keypoint_bytes));
    frame.descriptors.resize(frame.keypoints.size());
    for (std::size_t i = 0; i < frame.keypoints.size(); ++i) {
        Keypoint& k = frame.keypoints[i];
        k.u = getFloat(in, 4 * largest_image_px);
        k.v = getFloat(in, 4 * largest_image_px);
        k.depth_m = getFloat(in, farthest_m);
        k.angle_rad = getFloat(in, two_turns_rad);
        k.octave = in.get<std::uint8_t>();
        if (k.octave >= levels)
            throw DamagedBytes("a keypoint on a pyramid level that does not exist");
        frame.descriptors[i] = getDescriptor(in);
    }
    frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
    return frame;
}

void put(const Keyframe& keyframe, ByteWriter& out) {
    put(keyframe.frame, out);
    encodePose(keyframe.T_cam_world, out);
    out.putCount(keyframe.part);
    out.put(static_cast<std::uint8_t>(keyframe.link));
    out.put<std::uint8_t>(keyframe.culled);
    if (!keyframe.culled) return;
    out.putCount(keyframe.parent);
    encodePose(keyframe.T_cam_parent, out);
}

Link getLink(ByteReader& in) {
    const auto link = in.get<std::uint8_t>();
    if (link > static_cast<std::uint8_t>(Link::None)) throw DamagedBytes("a link of no kind");
    return static_cast<Link>(link);
}

Keyframe getKeyframe(ByteReader& in, int id, std::size_t keyframes, const Camera& camera,
                     int levels) {
    Keyframe keyframe;
    keyframe.id = id;
    keyframe.frame = getFrame(in, camera, levels);
    keyframe.landmarks.assign(keyframe.frame.keypoints.size(), no_landmark);
    keyframe.T_cam_world = decodePose(in);
    keyframe.part = getIndex(in, keyframes, "part");
    keyframe.link = getLink(in);
    keyframe.culled = in.get<std::uint8_t>() != 0;
    if (!keyframe.culled) return keyframe;
    keyframe.parent = getIndex(in, keyframes, "keyframe");
    keyframe.T_cam_parent = decodePose(in);
    return keyframe;
}

void checkCulled(const std::vector<Keyframe>& keyframes) {
    for (const Keyframe& keyframe : keyframes) {
        if (!keyframe.culled) continue;
        if (!keyframe.landmarks.empty() || keyframes[keyframe.parent].culled) {
            throw DamagedBytes("a culled keyframe that is not tied to a living one");
        }
    }
}

void put(const Landmark& landmark, ByteWriter& out) {
    put(landmark.position, out);
    put(landmark.view_direction, out);
    out.put(landmark.level0_distance);
    put(landmark.descriptor, out);
    out.putCount(landmark.first_keyframe);
    out.put<std::int32_t>(landmark.times_expected);
    out.put<std::int32_t>(landmark.times_found);
    out.putCount(landmark.observations.size());
    for (const Observation& o : landmark.observations) {
        out.putCount(o.keyframe);
        out.putCount(o.keypoint);
    }
}

/** Notes the observations at the keyframes, too. */
Landmark getLandmark(ByteReader& in, int id, std::vector<Keyframe>& keyframes) {
    Landmark landmark;
    landmark.position = getVector(in);
    landmark.view_direction = getVector(in);
    landmark.level0_distance = getFinite(in);
    if (landmark.level0_distance <= 0) throw DamagedBytes("a distance that is not positive");
    landmark.descriptor = getDescriptor(in);
    landmark.first_keyframe = getIndex(in, keyframes.size(), "keyframe");
    landmark.times_expected = in.get<std::int32_t>();
    landmark.times_found = in.get<std::int32_t>();
    landmark.observations.resize(in.getCount(observation_bytes));
    if (landmark.observations.empty()) throw DamagedBytes("a landmark that nobody has seen");
    int last = -1;
    for (Observation& o : landmark.observations) {
        o.keyframe = getIndex(in, keyframes.size(), "keyframe");
        o.keypoint = getIndex(in, keyframes[o.keyframe].landmarks.size(), "keypoint");
        int& seen = keyframes[o.keyframe].landmarks[o.keypoint];
        if (o.keyframe <= last || seen != no_landmark)
            throw DamagedBytes("a keypoint is named twice");
        seen = id;
        last = o.keyframe;
    }
    return landmark;
}

void put(const PoseEdge& edge, ByteWriter& out) {
    out.putCount(edge.from);
    out.putCount(edge.to);
    out.put<std::int32_t>(edge.inliers);
    encodePose(edge.T_from_to, out);
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) out.put(edge.information(i, j));
    }
}

PoseEdge getLoop(ByteReader& in, std::size_t keyframes) {
    PoseEdge edge;
    edge.kind = EdgeKind::Loop;
    edge.from = getIndex(in, keyframes, "keyframe");
    edge.to = getIndex(in, keyframes, "keyframe");
    edge.inliers = in.get<std::int32_t>();
    edge.T_from_to = decodePose(in);
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) {
            edge.information(i, j) = edge.information(j, i) = getFinite(in);
        }
    }
    if (edge.from == edge.to || edge.information.llt().info() != Eigen::Success) {
        throw DamagedBytes("a loop that says nothing");
    }
    return edge;
}

}  // namespace

void encodePose(const SE3& pose, ByteWriter& out) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) out.put(pose.R(i, j));
    }
    put(pose.t, out);
}

SE3 decodePose(ByteReader& in) {
    SE3 pose;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) pose.R(i, j) = getFinite(in);
    }
    pose.t = getVector(in);
    const double error = (pose.R * pose.R.transpose() - Eigen::Matrix3d::Identity()).norm();
    if (error > least_orthonormal || pose.R.determinant() < 0)
        throw DamagedBytes("a pose is no motion");
    return pose;
}

namespace {

/** Parents may have been culled later. */
void tieToTheLiving(Keyframe& keyframe, const SlamMap& map) {
    if (!map.keyframe(keyframe.parent).culled) return;
    while (map.keyframe(keyframe.parent).culled) {
        keyframe.parent = map.keyframe(keyframe.parent).parent;
    }
    keyframe.T_cam_parent =
        map.T_cam_world(keyframe.id) * map.T_cam_world(keyframe.parent).inverse();
}

}  // namespace

MapSnapshot takeSnapshot(const SlamMap& map, const Camera& camera, double scale_factor,
                         std::vector<PoseEdge> loops) {
    MapSnapshot snapshot;
    snapshot.camera = camera;
    snapshot.scale_factor = scale_factor;
    snapshot.levels = map.levels();
    snapshot.keyframes = map.keyframes();
    snapshot.loops = std::move(loops);
    std::vector<int> number(map.landmarks().size(), no_landmark);
    for (std::size_t id = 0; id < number.size(); ++id) {
        if (!map.landmarks()[id].alive) continue;
        number[id] = static_cast<int>(snapshot.landmarks.size());
        snapshot.landmarks.push_back(map.landmarks()[id]);
    }
    for (Keyframe& keyframe : snapshot.keyframes) {
        if (keyframe.culled) tieToTheLiving(keyframe, map);
        for (int& landmark : keyframe.landmarks) {
            if (landmark != no_landmark) landmark = number[landmark];
        }
    }
    return snapshot;
}

void encode(const MapSnapshot& snapshot, ByteWriter& out) {
    put(snapshot.camera, out);
    out.put(snapshot.scale_factor);
    out.putCount(snapshot.levels);
    out.putCount(snapshot.keyframes.size());
    for (const Keyframe& keyframe : snapshot.keyframes) put(keyframe, out);
    out.putCount(snapshot.landmarks.size());
    for (const Landmark& landmark : snapshot.landmarks) put(landmark, out);
    out.putCount(snapshot.loops.size());
    for (const PoseEdge& loop : snapshot.loops) put(loop, out);
}

MapSnapshot decodeSnapshot(ByteReader& in) {
    MapSnapshot snapshot;
    snapshot.camera = getCamera(in);
    snapshot.scale_factor = getFinite(in);
    snapshot.levels = in.get<std::int32_t>();
    if (snapshot.scale_factor <= 1 || snapshot.levels < 1 || snapshot.levels > most_levels) {
        throw DamagedBytes("an image pyramid that cannot be");
    }
    const std::size_t keyframes = in.getCount(keyframe_bytes);
    if (keyframes == 0) throw DamagedBytes("a map without keyframes");
    for (std::size_t id = 0; id < keyframes; ++id) {
        snapshot.keyframes.push_back(
            getKeyframe(in, static_cast<int>(id), keyframes, snapshot.camera, snapshot.levels));
    }
    checkCulled(snapshot.keyframes);
    const std::size_t landmarks = in.getCount(landmark_bytes);
    for (std::size_t id = 0; id < landmarks; ++id) {
        snapshot.landmarks.push_back(getLandmark(in, static_cast<int>(id), snapshot.keyframes));
    }
    const std::size_t loops = in.getCount(edge_bytes);
    for (std::size_t i = 0; i < loops; ++i) snapshot.loops.push_back(getLoop(in, keyframes));
    return snapshot;
}

}  // namespace rgbd_graphslam
