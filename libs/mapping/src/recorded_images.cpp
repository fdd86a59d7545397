#include "rgbd_graphslam/mapping/recorded_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"
#include "rgbd_graphslam/mapping/depth_timing.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;
namespace {

constexpr double stamp_tolerance_s = 5e-4;

/** Which entries of a rawlog are wanted. */
class Wanted {
  public:
    virtual ~Wanted() = default;
    /** \return the keyframe that the entry is, and the frame */
    virtual std::optional<std::size_t> operator()(std::size_t entry,
                                                  const CObservation::Ptr& observation,
                                                  CObservation3DRangeScan::Ptr& frame) = 0;
};

class WantedByEntry final : public Wanted {
  public:
    WantedByEntry(const FrameEntries& entries, const Trajectory& keyframes)
        : keyframes_(keyframes) {
        for (std::size_t k = 0; k < keyframes.size(); ++k) {
            if (const auto entry = entryAt(entries, keyframes[k].stamp_s)) indices_[*entry] = k;
        }
    }

    std::optional<std::size_t> operator()(std::size_t entry, const CObservation::Ptr& observation,
                                          CObservation3DRangeScan::Ptr& frame) override {
        const auto found = indices_.find(entry);
        if (found == indices_.end()) return std::nullopt;
        frame = asRgbdFrame(observation);
        if (!frame || !frame->hasRangeImage) return std::nullopt;
        const double stamp_s = keyframes_[found->second].stamp_s;
        const bool is_of_another_rawlog =
            std::abs(toSeconds(frame->timestamp) - stamp_s) > stamp_tolerance_s;
        if (is_of_another_rawlog) return std::nullopt;
        return found->second;
    }

  private:
    const Trajectory& keyframes_;
    std::map<std::size_t, std::size_t> indices_;  // of keyframes, by entry
};

class WantedByStamp final : public Wanted {
  public:
    WantedByStamp(const std::string& sensor_label, const Trajectory& keyframes)
        : keyframes_(keyframes), seen_(keyframes.size()) {
        if (!sensor_label.empty()) sensor_label_ = sensor_label;
    }

    std::optional<std::size_t> operator()(std::size_t, const CObservation::Ptr& observation,
                                          CObservation3DRangeScan::Ptr& frame) override {
        frame = asRgbdFrame(observation);
        if (!frame) return std::nullopt;
        if (!sensor_label_) sensor_label_ = frame->sensorLabel;
        if (frame->sensorLabel != *sensor_label_ || !frame->hasRangeImage) return std::nullopt;
        const auto index = indexAt(toSeconds(frame->timestamp));
        if (!index || seen_[*index]) return std::nullopt;
        seen_[*index] = true;
        return index;
    }

  private:
    std::optional<std::size_t> indexAt(double stamp_s) const {
        const auto near =
            std::lower_bound(keyframes_.begin(), keyframes_.end(), stamp_s - stamp_tolerance_s,
                             [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
        if (near == keyframes_.end() || near->stamp_s > stamp_s + stamp_tolerance_s)
            return std::nullopt;
        return static_cast<std::size_t>(near - keyframes_.begin());
    }

    const Trajectory& keyframes_;
    std::optional<std::string> sensor_label_;
    std::vector<bool> seen_;
};

std::unique_ptr<Wanted> wanted(const RecordedCamera& camera, const Trajectory& keyframes) {
    if (camera.entries.empty())
        return std::make_unique<WantedByStamp>(camera.sensor_label, keyframes);
    return std::make_unique<WantedByEntry>(camera.entries, keyframes);
}

void tellOfMissing(std::size_t found, std::size_t all, const std::string& rawlog,
                   const std::string& label) {
    if (found == 0) {
        throw Error("'" + rawlog + "' has no depth image of any keyframe",
                    "give --rawlog the file that the keyframes come from");
    }
    if (found == all) return;
    sayWarning(std::to_string(all - found) + " of " + std::to_string(all) +
               " frames have no depth image in '" + rawlog + "' and are left out (" + label + ")");
}

}  // namespace

std::size_t RecordedImages::forEach(const Trajectory& keyframes, const std::string& label,
                                    const Consume& consume, const Note& note) const {
    RawlogReader reader(camera_.rawlog);
    Progress progress(label, keyframes.size(), "frames");
    const auto is_wanted = wanted(camera_, keyframes);
    DepthStamps depth_stamps;
    std::size_t found = 0;
    const auto next = [&]() -> CObservation::Ptr {
        try {
            return reader.next();
        } catch (const Error&) {
            if (found < keyframes.size()) throw;
            return nullptr;  // a rawlog that is cut off behind the last keyframe serves
        }
    };
    for (std::size_t entry = 0; found < keyframes.size() || note; ++entry) {
        const auto observation = next();
        if (!observation) break;
        noteDepthStamps(*observation, depth_stamps);
        if (note) note(*observation);
        CObservation3DRangeScan::Ptr frame;
        const auto index = (*is_wanted)(entry, observation, frame);
        if (!index) continue;
        const StampedPose& pose = keyframes[*index];
        consume({*index, pose, depthStamp(depth_stamps, pose.stamp_s), toRgbdImage(frame),
                 cameraOf(*frame), cameraOnRobot(*frame)});
        progress.update(++found);
    }
    tellOfMissing(found, keyframes.size(), camera_.rawlog, label);
    return found;
}

}  // namespace rgbd_graphslam
