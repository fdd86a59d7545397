#include "rgbd_graphslam/mapping/keyframe_reader.h"

#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
namespace {

constexpr double stamp_tolerance_s = 5e-4;

std::optional<std::size_t> indexAt(const Trajectory& poses, double stamp_s) {
    const auto near =
        std::lower_bound(poses.begin(), poses.end(), stamp_s - stamp_tolerance_s,
                         [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
    if (near == poses.end() || near->stamp_s > stamp_s + stamp_tolerance_s) return std::nullopt;
    return static_cast<std::size_t>(near - poses.begin());
}

}  // namespace

void noteDepthStamps(const mrpt::obs::CObservation& observation, DepthStamps& stamps) {
    const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
    if (comment) stamps.merge(depthStampsIn(comment->text));
}

double depthStamp(const DepthStamps& stamps, double color_stamp_s) {
    const auto found = stamps.find(std::llround(1e6 * color_stamp_s));
    return found == stamps.end() ? color_stamp_s : 1e-6 * static_cast<double>(found->second);
}

SE3 depthPose(const StampedPose& keyframe, double depth_stamp_s, const Trajectory& trajectory) {
    constexpr double longest_gap_s = 0.2;
    const auto T_color = poseAt(trajectory, keyframe.stamp_s, longest_gap_s),
               T_depth = poseAt(trajectory, depth_stamp_s, longest_gap_s);
    if (!T_color || !T_depth) return keyframe.T_world_cam;
    return keyframe.T_world_cam * (T_color->inverse() * *T_depth);
}

std::size_t forEachKeyframe(const RecordedCamera& camera, const Trajectory& keyframes,
                            const std::string& label,
                            const std::function<void(const Keyframe3D&)>& consume,
                            const std::function<void(const CObservation&)>& note) {
    const std::string& rawlog = camera.rawlog;
    std::optional<std::string> sensor_label;
    if (!camera.sensor_label.empty()) sensor_label = camera.sensor_label;
    RawlogReader reader(rawlog);
    Progress progress(label, keyframes.size(), "frames");
    DepthStamps depth_stamps;
    std::vector<bool> seen(keyframes.size());
    std::size_t found = 0;
    const auto next = [&]() -> CObservation::Ptr {
        try {
            return reader.next();
        } catch (const Error&) {
            if (found < keyframes.size()) throw;
            return nullptr;  // a rawlog that is cut off behind the last keyframe serves
        }
    };
    while (found < keyframes.size() || note) {
        const auto observation = next();
        if (!observation) break;
        noteDepthStamps(*observation, depth_stamps);
        if (note) note(*observation);
        const auto frame = asRgbdFrame(observation);
        if (!frame) continue;
        if (!sensor_label) sensor_label = frame->sensorLabel;
        if (frame->sensorLabel != *sensor_label || !frame->hasRangeImage) continue;
        const auto index = indexAt(keyframes, toSeconds(frame->timestamp));
        if (!index || seen[*index]) continue;
        const StampedPose& pose = keyframes[*index];
        consume({*index, pose, depthStamp(depth_stamps, pose.stamp_s), toRgbdImage(frame),
                 cameraOf(*frame), cameraOnRobot(*frame)});
        seen[*index] = true;
        progress.update(++found);
    }
    if (found == 0) {
        throw Error("'" + rawlog + "' has no depth image at the stamp of any keyframe",
                    "give --rawlog the file that the keyframes come from");
    }
    if (found < keyframes.size()) {
        sayWarning(std::to_string(keyframes.size() - found) + " of " +
                   std::to_string(keyframes.size()) + " frames have no depth image in '" + rawlog +
                   "' and are left out (" + label + ")");
    }
    return found;
}

}  // namespace rgbd_graphslam
