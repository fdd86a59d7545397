#include "trajectory_record.h"

#include <algorithm>
#include <string>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t record_bytes =
    sizeof(double) + 1 + 3 * 4 + pose_bytes + sizeof(PackedCovariance);
constexpr float largest_variance = 1e12f;

void put(const FrameRecord& record, ByteWriter& out) {
    out.put(record.stamp_s);
    out.put(static_cast<std::uint8_t>(record.origin));
    out.put<std::int32_t>(record.inliers);
    out.putCount(record.reference_keyframe);
    encodePose(record.T_cam_reference, out);
    out.put<std::int32_t>(record.keyframe.value_or(-1));
    for (const float entry : record.covariance) out.put(entry);
}

FrameRecord getRecord(ByteReader& in, std::size_t keyframes) {
    FrameRecord record;
    record.stamp_s = getFinite(in);
    const auto origin = in.get<std::uint8_t>();
    if (origin > static_cast<std::uint8_t>(FrameOrigin::Uncertain))
        throw DamagedBytes("a frame of no kind");
    record.origin = static_cast<FrameOrigin>(origin);
    record.inliers = in.get<std::int32_t>();
    record.reference_keyframe = getIndex(in, std::max<std::size_t>(1, keyframes), "keyframe");
    record.T_cam_reference = decodePose(in);
    const auto keyframe = in.get<std::int32_t>();
    if (keyframe >= static_cast<std::int64_t>(keyframes))
        throw DamagedBytes("a frame of no keyframe");
    if (keyframe >= 0) record.keyframe = keyframe;
    for (float& entry : record.covariance) entry = getFloat(in, largest_variance);
    return record;
}

}  // namespace

PackedCovariance packed(const Matrix6d& covariance) {
    PackedCovariance result;
    auto entry = result.begin();
    for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) {
            *entry++ = std::clamp(static_cast<float>(covariance(i, j)), -largest_variance,
                                  largest_variance);
        }
    }
    return result;
}

Matrix6d unpacked(const PackedCovariance& packed) {
    Matrix6d covariance;
    auto entry = packed.begin();
    for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) covariance(i, j) = covariance(j, i) = *entry++;
    }
    return covariance;
}

SE3 FrameRecord::T_cam_world(const SlamMap& map) const {
    return T_cam_reference * map.T_cam_world(reference_keyframe);
}

TrackedFrame FrameRecord::view(const SlamMap& map, const MapUncertainty& uncertainty) const {
    TrackedFrame frame;
    frame.stamp_s = stamp_s;
    frame.origin = origin;
    frame.inliers = inliers;
    frame.reference_keyframe = reference_keyframe;
    frame.keyframe = keyframe;
    frame.T_reference_cam = T_cam_reference.inverse();
    if (map.keyframes().empty()) return frame;
    frame.submap = map.keyframe(reference_keyframe).submap;
    frame.T_world_cam = T_cam_world(map).inverse();
    if (origin == FrameOrigin::Lost) return frame;
    const SE3 T_cam_origin = T_cam_world(map) * map.T_cam_world(frame.submap).inverse();
    const double scale = origin == FrameOrigin::DeadReckoned ? 1 : uncertainty.scale();
    frame.covariance = uncertainty.inWorld(scale * unpacked(covariance), reference_keyframe,
                                           T_cam_reference, T_cam_origin);
    return frame;
}

void TrajectoryRecord::requireLater(double stamp_s) const {
    if (records_.empty() || !(stamp_s <= records_.back().stamp_s)) return;
    throw Error("frame at " + std::to_string(stamp_s) + " s is not later than the last, " +
                    std::to_string(records_.back().stamp_s) + " s",
                "leave it out or sort the frames");
}

SE3 TrajectoryRecord::lastPose(const SlamMap& map) const {
    return records_.empty() ? map.T_cam_world(0) : records_.back().T_cam_world(map);
}

std::vector<TrackedFrame> TrajectoryRecord::views(const SlamMap& map,
                                                  const MapUncertainty& uncertainty) const {
    std::vector<TrackedFrame> views;
    for (const FrameRecord& record : records_) views.push_back(record.view(map, uncertainty));
    return views;
}

void TrajectoryRecord::revise(const std::vector<std::pair<double, SE3>>& poses,
                              const SlamMap& map) {
    if (poses.size() < 3) return;
    const auto find = [&](double stamp_s) {
        return std::lower_bound(
            records_.begin(), records_.end(), stamp_s,
            [](const FrameRecord& record, double s) { return record.stamp_s < s; });
    };
    std::vector<SE3> corrections(poses.size());
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        const auto record = find(poses[i].first);
        if (record == records_.end()) return;
        corrections[i] = poses[i].second * record->T_cam_world(map).inverse();
    }
    std::size_t next = 1;
    for (auto record = find(poses.front().first); record != records_.end(); ++record) {
        while (next < poses.size() && poses[next].first < record->stamp_s) ++next;
        if (next == poses.size()) break;
        if (record->origin != FrameOrigin::DeadReckoned || record->keyframe) continue;
        const double share =
            (record->stamp_s - poses[next - 1].first) / (poses[next].first - poses[next - 1].first);
        const SE3 correction = interpolate(corrections[next - 1], corrections[next], share);
        record->T_cam_reference = correction * record->T_cam_reference;
    }
}

void TrajectoryRecord::save(ByteWriter& out) const {
    out.putCount(records_.size());
    for (const FrameRecord& record : records_) put(record, out);
}

void TrajectoryRecord::load(ByteReader& in, std::size_t keyframes) {
    records_.resize(in.getCount(record_bytes));
    for (FrameRecord& record : records_) record = getRecord(in, keyframes);
}

}  // namespace rgbd_graphslam
