/** The whole map at once. */
#pragma once
#include <memory>
#include <optional>

#include "rgbd_graphslam/slam/map_adjustment.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** Adjusts all keyframes and landmarks (Ceres), keyframe 0 held: in the background after a loop,
 *  for its new observations bend the map beyond what local adjustments reach, and once at the end.
 */
class GlobalBundleAdjuster {
  public:
    /** All arguments must outlive the adjuster. */
    GlobalBundleAdjuster(const SlamOptions& options, const RigCameras& cameras, SlamMap& map);

    /** Begins on a copy of the map as it is. Nothing may be pending. */
    void start(int iterations);

    bool pending() const { return pending_ != nullptr; }

    /** Waits, and writes the solution into the map; what has joined the map since moves along. No
     *  local adjustment may be pending.
     *  \return CPU ms that it took */
    double applyPendingAdjustment();

    /** start() and applyPendingAdjustment() in one, on this thread. */
    void adjustNow(int iterations);

    void save(ByteWriter& out) const;
    /** Begins a pending adjustment again. */
    void load(ByteReader& in);

  private:
    std::optional<MapAdjustment> wholeMap() const;
    void solveInBackground(MapAdjustment adjustment);

    const SlamOptions& options_;
    const RigCameras& cameras_;
    SlamMap& map_;
    int iterations_ = 0;
    /** As it was begun: what is at work cannot be read until it is done. */
    std::optional<MapAdjustment> begun_;
    std::unique_ptr<BackgroundBundleAdjustment> pending_;
};

}  // namespace rgbd_graphslam
