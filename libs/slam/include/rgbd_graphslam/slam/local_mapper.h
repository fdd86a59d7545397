/** The map around the newest keyframe. */
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rgbd_graphslam/slam/map_adjustment.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** Makes landmarks, joins double ones, drops what does not prove itself, and adjusts the poses and
 *  points around a new keyframe. The adjustment works on a copy in the background; the caller says
 *  at which frame the result enters the map. */
class LocalMapper {
  public:
    /** All arguments must outlive the mapper. */
    LocalMapper(const SlamOptions& options, const RigCameras& cameras, SlamMap& map);

    /** Grows the map by a keyframe that was just added with its tracked landmarks, and starts the
     *  adjustment. applyPendingAdjustment() must have been called since the last time. */
    void insert(int keyframe);

    bool pending() const { return pending_ != nullptr; }
    /** Waits for the adjustment and writes it into the map. Does nothing when none is pending.
     *  \return CPU ms that the adjustment took */
    double applyPendingAdjustment();

    /** What coming keyframes depend on. */
    void save(ByteWriter& out) const;
    /** Starts a pending adjustment again, for which the map must be loaded: nothing that it reads
     *  has changed since it began.
     *  \throws DamagedBytes */
    void load(ByteReader& in);

    /** Looks for landmarks in a keyframe: a free keypoint there becomes an observation, an occupied
     *  one reveals a double landmark, which is fused. */
    void joinInto(int keyframe, std::vector<int> landmarks);

  private:
    void startAdjustment(int keyframe);
    void createFromDepth(int id);
    void triangulateWithNeighbors(int id);
    void joinWithNeighbors(int id);
    void join(int landmark, int keyframe, int keypoint);
    void cullLandmarks(int keyframe);
    void cullKeyframes(int id);
    void forgetOldest(int newest);
    bool isRedundant(const Landmark& landmark, int keyframe, int octave) const;
    double redundancy(const Keyframe& keyframe) const;
    MapAdjustment adjustmentAround(int id) const;

    const SlamOptions& options_;
    const RigCameras& cameras_;
    SlamMap& map_;
    std::vector<int> recent_;  // landmarks still on probation
    std::unique_ptr<BackgroundBundleAdjustment> pending_;
    int adjusted_keyframe_ = 0;  // around which the pending adjustment is
};

}  // namespace rgbd_graphslam
