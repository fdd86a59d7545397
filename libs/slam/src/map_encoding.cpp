#include "rgbd_graphslam/slam/map_encoding.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

namespace rgbd_graphslam {
namespace {

constexpr int largest_image_px = 1 << 16;
constexpr double least_orthonormal = 1e-6;
constexpr std::size_t observation_bytes = 2 * sizeof(std::uint32_t);

void put(const Eigen::Vector3d& v, ByteWriter& out) {
    for (int i = 0; i < 3; ++i) out.put(v[i]);
}

std::vector<int> getNumbers(ByteReader& in, int first, std::size_t end) {
    std::vector<int> numbers(in.getCount(sizeof(std::int32_t)));
    for (int& number : numbers) {
        number = in.get<std::int32_t>();
        if (number < first || number >= static_cast<std::int64_t>(end)) {
            throw DamagedBytes("a number of nothing");
        }
    }
    return numbers;
}

Eigen::Vector3d getVector(ByteReader& in) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = getFinite(in);
    return v;
}

int getOctave(ByteReader& in, int levels) {
    const auto octave = in.get<std::uint8_t>();
    if (octave >= levels) throw DamagedBytes("a pyramid level that does not exist");
    return octave;
}

int getCameraNumber(ByteReader& in, int cameras) {
    const auto camera = in.get<std::uint8_t>();
    if (camera >= cameras) throw DamagedBytes("a camera that the rig does not have");
    return camera;
}

}  // namespace

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

int getIndex(ByteReader& in, std::size_t end, const char* what) {
    const auto index = in.get<std::uint32_t>();
    if (index >= end) {
        throw DamagedBytes("a " + std::string(what) + " with number " + std::to_string(index) +
                           " of " + std::to_string(end));
    }
    return static_cast<int>(index);
}

void putFlag(bool flag, ByteWriter& out) {
    out.put<std::uint8_t>(flag);
}

bool getFlag(ByteReader& in) {
    return in.get<std::uint8_t>() != 0;
}

void putNumbers(const std::vector<int>& numbers, ByteWriter& out) {
    out.putCount(numbers.size());
    for (const int number : numbers) out.put<std::int32_t>(number);
}

std::vector<int> getNumbers(ByteReader& in, std::size_t end) {
    return getNumbers(in, 0, end);
}

std::vector<int> getLandmarks(ByteReader& in, std::size_t end) {
    return getNumbers(in, no_landmark, end);
}

int getTally(ByteReader& in) {
    constexpr int most = 1 << 30;
    const auto tally = in.get<std::int32_t>();
    if (tally < 0 || tally > most) throw DamagedBytes("an impossible count");
    return tally;
}

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

void put(const DeadReckoning& reckoning, ByteWriter& out) {
    const auto& [T_odometry_cam, R_gyroscope_cam, sigma] = reckoning;
    putFlag(T_odometry_cam.has_value(), out);
    if (T_odometry_cam) encodePose(*T_odometry_cam, out);
    putFlag(R_gyroscope_cam.has_value(), out);
    if (R_gyroscope_cam) encodePose({*R_gyroscope_cam, Eigen::Vector3d::Zero()}, out);
    putFlag(sigma.has_value(), out);
    if (!sigma) return;
    for (const double s : *sigma) out.put(s);
}

DeadReckoning getReckoning(ByteReader& in) {
    DeadReckoning reckoning;
    if (getFlag(in)) reckoning.T_odometry_cam = decodePose(in);
    if (getFlag(in)) reckoning.R_gyroscope_cam = decodePose(in).R;
    if (getFlag(in)) {
        reckoning.sigma.emplace();
        for (double& s : *reckoning.sigma) s = getFinite(in);
    }
    return reckoning;
}

void put(const Descriptor& descriptor, ByteWriter& out) {
    for (const std::uint64_t word : descriptor) out.put(word);
}

Descriptor getDescriptor(ByteReader& in) {
    Descriptor descriptor;
    for (std::uint64_t& word : descriptor) word = in.get<std::uint64_t>();
    return descriptor;
}

void put(const LandmarkPatch& seen, ByteWriter& out) {
    const Patch& patch = seen.patch;
    out.put(static_cast<std::uint8_t>(seen.octave));
    out.put(static_cast<std::uint8_t>(seen.camera));
    for (const float f : {patch.corner.x, patch.corner.y}) out.put(f);
    out.putBytes({reinterpret_cast<const char*>(patch.gray.data()), patch.gray.size()});
}

LandmarkPatch getPatch(ByteReader& in, int levels, int cameras) {
    LandmarkPatch seen;
    Patch& patch = seen.patch;
    seen.octave = getOctave(in, levels);
    seen.camera = getCameraNumber(in, cameras);
    for (float* f : {&patch.corner.x, &patch.corner.y}) *f = getFloat(in, Patch::center);
    std::memcpy(patch.gray.data(), in.getBytes(patch.gray.size()).data(), patch.gray.size());
    return seen;
}

void put(const Camera& camera, ByteWriter& out) {
    const Intrinsics in = camera.intrinsics();
    out.put<std::int32_t>(in.width);
    out.put<std::int32_t>(in.height);
    for (const double d : {in.fx, in.fy, in.cx, in.cy}) out.put(d);
    const std::vector<double> coefficients = lensCoefficients(in.lens);
    out.putText(lensModel(in.lens));
    out.putCount(coefficients.size());
    for (const double k : coefficients) out.put(k);
}

Lens getLens(ByteReader& in) {
    const std::string model = in.getText();
    std::vector<double> coefficients(in.getCount(sizeof(double)));
    for (double& k : coefficients) k = getFinite(in);
    try {
        return makeLens(model, coefficients);
    } catch (const std::invalid_argument&) {
        throw DamagedBytes("a lens of no known model");
    }
}

Camera getCamera(ByteReader& in) {
    Intrinsics camera;
    for (int* side : {&camera.width, &camera.height}) {
        *side = in.get<std::int32_t>();
        if (*side < 1 || *side > largest_image_px)
            throw DamagedBytes("an image of impossible size");
    }
    for (double* d : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *d = getFinite(in);
    if (camera.fx <= 0 || camera.fy <= 0) throw DamagedBytes("a focal length that is not positive");
    camera.lens = getLens(in);
    const Camera model = camera;
    if (!model.isInvertible()) throw DamagedBytes("a lens distortion that cannot be undone");
    return model;
}

void put(const Rig& rig, ByteWriter& out) {
    out.putCount(rig.cameras.size());
    for (const RigCamera& camera : rig.cameras) {
        out.putText(camera.label);
        put(camera.model, out);
        encodePose(camera.T_body_cam, out);
    }
}

Rig getRig(ByteReader& in) {
    constexpr std::size_t most_cameras = 255;
    Rig rig;
    const std::size_t cameras = in.getCount(camera_bytes);
    if (cameras == 0 || cameras > most_cameras)
        throw DamagedBytes("a rig of no or too many cameras");
    for (std::size_t i = 0; i < cameras; ++i) {
        RigCamera camera;
        camera.label = in.getText();
        camera.model = getCamera(in);
        camera.T_body_cam = decodePose(in);
        rig.cameras.push_back(camera);
    }
    return rig;
}

void put(const Frame& frame, ByteWriter& out) {
    out.put(frame.stamp_s);
    out.putCount(frame.keypoints.size());
    for (std::size_t i = 0; i < frame.keypoints.size(); ++i) {
        const Keypoint& k = frame.keypoints[i];
        for (const float f : {k.u, k.v, k.depth_m, k.angle_rad}) out.put(f);
        out.put(static_cast<std::uint8_t>(k.octave));
        putFlag(k.aligned, out);
        out.put(static_cast<std::uint8_t>(k.camera));
        put(frame.descriptors[i], out);
    }
}

Frame getFrame(ByteReader& in, const RigCameras& cameras, int levels) {
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
        k.octave = getOctave(in, levels);
        k.aligned = getFlag(in);
        k.camera = getCameraNumber(in, cameras.count());
        frame.descriptors[i] = getDescriptor(in);
    }
    frame.grid = cameras.gridOf(frame.keypoints);
    return frame;
}

void put(Link link, ByteWriter& out) {
    out.put(static_cast<std::uint8_t>(link));
}

Link getLink(ByteReader& in) {
    const auto link = in.get<std::uint8_t>();
    if (link > static_cast<std::uint8_t>(Link::None)) throw DamagedBytes("a link of no kind");
    return static_cast<Link>(link);
}

void put(const Keyframe& keyframe, ByteWriter& out) {
    put(keyframe.frame, out);
    encodePose(keyframe.T_cam_world, out);
    out.putCount(keyframe.submap);
    put(keyframe.link, out);
    putFlag(keyframe.culled, out);
    if (!keyframe.culled) return;
    out.putCount(keyframe.parent);
    encodePose(keyframe.T_cam_parent, out);
}

Keyframe getKeyframe(ByteReader& in, int id, std::size_t keyframes, const RigCameras& cameras,
                     int levels) {
    Keyframe keyframe;
    keyframe.id = id;
    keyframe.frame = getFrame(in, cameras, levels);
    keyframe.landmarks.assign(keyframe.frame.keypoints.size(), no_landmark);
    keyframe.T_cam_world = decodePose(in);
    keyframe.submap = getIndex(in, keyframes, "submap");
    keyframe.link = getLink(in);
    keyframe.culled = getFlag(in);
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
    putFlag(landmark.patch != nullptr, out);
    if (landmark.patch) put(*landmark.patch, out);
    out.putCount(landmark.first_keyframe);
    out.put<std::int32_t>(landmark.times_expected);
    out.put<std::int32_t>(landmark.times_found);
    out.putCount(landmark.observations.size());
    for (const Observation& o : landmark.observations) {
        out.putCount(o.keyframe);
        out.putCount(o.keypoint);
    }
}

Landmark getLandmark(ByteReader& in, int id, std::vector<Keyframe>& keyframes, int levels,
                     int cameras) {
    Landmark landmark;
    landmark.position = getVector(in);
    landmark.view_direction = getVector(in);
    landmark.level0_distance = getFinite(in);
    if (landmark.level0_distance <= 0) throw DamagedBytes("a distance that is not positive");
    landmark.descriptor = getDescriptor(in);
    if (getFlag(in))
        landmark.patch = std::make_shared<LandmarkPatch>(getPatch(in, levels, cameras));
    landmark.first_keyframe = getIndex(in, keyframes.size(), "keyframe");
    landmark.times_expected = getTally(in);
    landmark.times_found = getTally(in);
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

PoseEdge getEdge(ByteReader& in, std::size_t keyframes, EdgeKind kind) {
    PoseEdge edge;
    edge.kind = kind;
    edge.from = getIndex(in, keyframes, "keyframe");
    edge.to = getIndex(in, keyframes, "keyframe");
    edge.inliers = in.get<std::int32_t>();
    edge.T_from_to = decodePose(in);
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) {
            edge.information(i, j) = edge.information(j, i) = getFinite(in);
        }
    }
    const bool loop = kind == EdgeKind::Loop;
    if (edge.from == edge.to || (loop && edge.information.llt().info() != Eigen::Success)) {
        throw DamagedBytes("an edge that says nothing");
    }
    return edge;
}

}  // namespace rgbd_graphslam
