/** A bundle adjustment of a piece of the map. */
#pragma once
#include <functional>
#include <future>
#include <vector>

#include "rgbd_graphslam/estimation/bundle_adjustment.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** A copy of some keyframes and landmarks as a problem to solve, and the way back into the map,
 *  which may have grown and lost pieces in between. */
class MapAdjustment {
  public:
    /** \param free keyframes that are moved, by rising id
     *  \param fixed keyframes that hold them
     *  \param landmarks by rising id */
    MapAdjustment(const SlamMap& map, const RigCameras& cameras, const SensorOptions& sensor,
                  std::vector<int> free, const std::vector<int>& fixed, std::vector<int> landmarks);

    BundleProblem problem;

    /** Writes the solution into the map. Landmarks that are gone, or whose id another has taken,
     *  are left alone. */
    void apply(SlamMap& map) const;

    /** Keyframes that have joined the map since, and what they alone see, move with the newest one
     *  that took part. Before apply(). */
    void carryYounger(SlamMap& map) const;

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes when the bytes do not fit the map */
    MapAdjustment(ByteReader& in, const SlamMap& map, const RigCameras& cameras);

  private:
    bool isStill(int landmark, const SlamMap& map) const;
    void moveUnadjusted(int keyframe, const SE3& new_T_cam_world, SlamMap& map) const;

    std::vector<int> keyframes_, landmarks_;  // of each camera and point
    std::vector<int> observation_keyframe_;
    int keyframes_in_map_ = 0;  // when the copy was made
};

/** Landmarks with at least two observations among what the keyframes see, by rising id. */
std::vector<int> landmarksSeenBy(const std::vector<int>& keyframes, const SlamMap& map);

/** An adjustment that another thread solves. */
class BackgroundBundleAdjustment {
  public:
    using Solve = std::function<void(BundleProblem&)>;
    BackgroundBundleAdjustment(MapAdjustment adjustment, const Solve& solve);
    ~BackgroundBundleAdjustment();
    BackgroundBundleAdjustment(const BackgroundBundleAdjustment&) = delete;
    BackgroundBundleAdjustment& operator=(const BackgroundBundleAdjustment&) = delete;

    /** \return CPU ms that it took */
    double wait();
    /** The solution, after wait(). */
    const MapAdjustment& adjustment() const { return adjustment_; }

  private:
    MapAdjustment adjustment_;
    std::future<double> cpu_ms_;
};

}  // namespace rgbd_graphslam
