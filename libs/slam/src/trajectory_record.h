/** Every frame of a run. */
#pragma once
#include <array>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "pose_uncertainty.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** The upper triangle of a covariance, row by row: small, as there is one per frame. */
using PackedCovariance = std::array<float, 21>;
PackedCovariance packed(const Matrix6d& covariance);
Matrix6d unpacked(const PackedCovariance& packed);

/** A frame as it is kept: tied to a keyframe, so that it moves with the map. */
struct FrameRecord {
    double stamp_s = 0;
    FrameOrigin origin = FrameOrigin::Lost;
    int inliers = 0;
    int reference_keyframe = 0;
    SE3 T_cam_reference;
    std::optional<int> keyframe;
    /** Against the map around; of no meaning when lost. */
    PackedCovariance covariance{};

    /** The reference keyframe must be in the map. */
    SE3 T_cam_world(const SlamMap& map) const;
    /** As others see it, where the map says it is now. */
    TrackedFrame view(const SlamMap& map, const MapUncertainty& uncertainty) const;
};

/** In order of time. */
class TrajectoryRecord {
  public:
    /** \throws Error when a frame is not later than the last one */
    void requireLater(double stamp_s) const;
    void add(const FrameRecord& record) { records_.push_back(record); }

    /** 0 before any frame. */
    int lastReference() const { return records_.empty() ? 0 : records_.back().reference_keyframe; }
    /** Whether the map was seen by the last frame. */
    bool lastSawMap() const {
        return !records_.empty() && records_.back().origin == FrameOrigin::Tracked;
    }
    /** T_cam_world of the last frame, or where it was known last; the map must not be empty. */
    SE3 lastPose(const SlamMap& map) const;
    std::vector<TrackedFrame> views(const SlamMap& map, const MapUncertainty& uncertainty) const;

    /** Frames by dead reckoning get the poses that they turn out to have had, those in between are
     *  bent along.
     *  \param poses stamps and T_cam_world of some of them, after the last and before the next
     * frame located by landmarks, which stay */
    void revise(const std::vector<std::pair<double, SE3>>& poses, const SlamMap& map);

    void save(ByteWriter& out) const;
    /** \param keyframes there are
     *  \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

  private:
    std::deque<FrameRecord> records_;  // grows without moving
};

}  // namespace rgbd_graphslam
