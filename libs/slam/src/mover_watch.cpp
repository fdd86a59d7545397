#include "mover_watch.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr double interval_s = 0.5;
constexpr std::size_t most_remembered = 400;
/** Comparing with more takes longer and finds hardly more. */
constexpr std::size_t most_compared = 8;
/** A mover that stood in some of the remembered images is still seen through by the others. */
constexpr MovingBlocks::Rules rules{2, 0.3, 2, 1.0, 0.05, 3};
constexpr float mm = 1000, farthest_mm = 65535;

/** As checkpoints keep it: a resumed run must compare the same numbers. */
std::vector<float> inWholeMillimeters(std::vector<float> depth_m) {
    for (float& z : depth_m) z = std::min(std::round(mm * z), farthest_mm) / mm;
    return depth_m;
}

void putDepth(const std::vector<float>& depth_m, ByteWriter& out) {
    for (const float z : depth_m) out.put(static_cast<std::uint16_t>(std::lround(mm * z)));
}

std::vector<float> getDepth(std::size_t blocks, ByteReader& in) {
    std::vector<float> depth_m(blocks);
    for (float& z : depth_m) z = static_cast<float>(in.get<std::uint16_t>()) / mm;
    return depth_m;
}

}  // namespace

MoverWatch::MoverWatch(const RigCameras& cameras)
    : cameras_(cameras), pixels_(cameras.sensor(0)), blocks_(pixels_.camera(), rules) {}

std::vector<const Sight*> MoverWatch::sightsIn(int submap, const SlamMap& map) {
    std::vector<const Sight*> sights;
    for (Remembered& remembered : remembered_) {
        if (map.keyframe(remembered.reference).submap != submap) continue;
        const SE3 T_cam_world = remembered.T_cam_reference * map.T_cam_world(remembered.reference);
        remembered.sight.T_world_cam = T_cam_world.inverse();
        sights.push_back(&remembered.sight);
    }
    return sights;
}

std::vector<char> MoverWatch::moving(const Frame& frame, const SE3& T_cam_world, int submap,
                                     const SlamMap& map) {
    compared_last_ = !compared_last_;
    if (compared_last_) look(frame, T_cam_world, submap, map);
    if (mask_.empty()) return {};
    std::vector<char> result;
    for (const Keypoint& keypoint : frame.keypoints)
        result.push_back(keypoint.camera == 0 && isMasked(keypoint));
    return result;
}

void MoverWatch::look(const Frame& frame, const SE3& T_cam_world, int submap, const SlamMap& map) {
    mask_.clear();
    const Sight sight{frame.stamp_s, T_cam_world.inverse(),
                      inWholeMillimeters(frame.view.get().depth_m), 0};
    if (sight.depth_m.size() != pixels_.count()) return;
    mask_ = blocks_.find(sight, blocks_.overlapping(sight, sightsIn(submap, map), most_compared));
    depth_m_ = sight.depth_m;
    if (std::none_of(mask_.begin(), mask_.end(), [](int moves) { return moves; })) mask_.clear();
}

/** A keypoint beside a moving block belongs to it, unless its depth says otherwise. */
bool MoverWatch::isMasked(const Keypoint& keypoint) const {
    const Camera& rectified = cameras_[0].camera();
    Eigen::Vector2d pixel(keypoint.u, keypoint.v);
    if (rectified.hasDistortion())
        pixel = rectified.pinhole().project(rectified.unproject(keypoint.u, keypoint.v, 1));
    const int block = pixels_.blockAt(pixel.x(), pixel.y());
    if (block < 0) return false;
    const int width = pixels_.camera().width, height = pixels_.camera().height;
    const int u = block % width, v = block / width;
    for (int y = std::max(v - 1, 0); y <= std::min(v + 1, height - 1); ++y) {
        for (int x = std::max(u - 1, 0); x <= std::min(u + 1, width - 1); ++x) {
            const int i = y * width + x;
            const bool near = keypoint.depth_m <= 0 ||
                              std::abs(keypoint.depth_m - depth_m_[i]) <= blocks_.step(depth_m_[i]);
            if (mask_[i] && near) return true;
        }
    }
    return false;
}

void MoverWatch::note(const Frame& frame, const SE3& T_cam_world, int reference,
                      const SlamMap& map) {
    if (!remembered_.empty() && frame.stamp_s - remembered_.back().sight.stamp_s < interval_s)
        return;
    const DenseView& view = frame.view.get();
    if (view.depth_m.size() != pixels_.count()) return;
    if (remembered_.size() == most_remembered) remembered_.pop_front();
    Remembered& remembered = remembered_.emplace_back();
    remembered.sight.stamp_s = frame.stamp_s;
    remembered.sight.depth_m = inWholeMillimeters(view.depth_m);
    remembered.reference = reference;
    remembered.T_cam_reference = T_cam_world * map.T_cam_world(reference).inverse();
}

void MoverWatch::save(ByteWriter& out) const {
    out.putCount(remembered_.size());
    for (const Remembered& remembered : remembered_) {
        out.put(remembered.sight.stamp_s);
        out.putCount(remembered.reference);
        encodePose(remembered.T_cam_reference, out);
        putDepth(remembered.sight.depth_m, out);
    }
    putFlag(compared_last_, out);
    putFlag(!mask_.empty(), out);
    if (mask_.empty()) return;
    for (const std::uint8_t moves : mask_) out.put(moves);
    putDepth(depth_m_, out);
}

void MoverWatch::load(ByteReader& in, std::size_t keyframes) {
    const std::size_t blocks = pixels_.count();
    remembered_.resize(in.getCount(sizeof(double) + pose_bytes + 2 * blocks));
    for (Remembered& remembered : remembered_) {
        remembered.sight.stamp_s = getFinite(in);
        remembered.reference = getIndex(in, keyframes, "keyframe");
        remembered.T_cam_reference = decodePose(in);
        remembered.sight.depth_m = getDepth(blocks, in);
    }
    compared_last_ = getFlag(in);
    mask_.clear();
    if (!getFlag(in)) return;
    mask_.resize(blocks);
    for (std::uint8_t& moves : mask_) moves = getFlag(in);
    depth_m_ = getDepth(blocks, in);
}

void removeKeypoints(const std::vector<char>& removed, const RigCameras& cameras, Frame& frame,
                     std::vector<int>& landmarks) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < removed.size(); ++i) {
        if (removed[i]) continue;
        frame.keypoints[kept] = frame.keypoints[i];
        frame.descriptors[kept] = frame.descriptors[i];
        landmarks[kept] = landmarks[i];
        if (!frame.patches.empty()) frame.patches[kept] = frame.patches[i];
        ++kept;
    }
    frame.keypoints.resize(kept);
    frame.descriptors.resize(kept);
    landmarks.resize(kept);
    if (!frame.patches.empty()) frame.patches.resize(kept);
    frame.grid = cameras.gridOf(frame.keypoints);
}

}  // namespace rgbd_graphslam
