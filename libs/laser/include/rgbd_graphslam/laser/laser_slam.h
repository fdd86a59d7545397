/** SLAM on laser scans and wheel odometry. */
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/laser/laser_options.h"
#include "rgbd_graphslam/laser/planar_scan.h"

namespace rgbd_graphslam {

/** A scan of the map. */
struct Keyscan {
    PlanarScan scan;
    PlanarPose T_world_base;
    /** As tracking alone had put it. */
    PlanarPose T_tracked_base;
    /** Way from the first one, m. */
    double path_m = 0;
};

/** What became of a scan. */
struct TrackedScan {
    double stamp_s = 0;
    int keyscan = 0;
    PlanarPose T_keyscan_base;
    /** Aligned to the submap; else moved by odometry alone. */
    bool matched = false;
    bool is_keyscan = false;
    std::size_t inliers = 0;
    /** Of the inliers' distances to their lines, m. */
    double rms_m = 0;
};

/** Scan-to-submap tracking with loop closure in a pose graph.
 *
 *  Each scan is aligned to a submap of the last keyscans, with the odometry's motion as a prior, so
 *  that directions in which scans say nothing (along a corridor) follow the wheels. Loops are
 *  searched for by correlation in a window that grows with the way since the last loop. A loop is
 *  accepted when most points meet the older scans, no other pose in the window fits as well, and
 *  few beams cross walls of the other scans; after a long way only when a second loop further on
 *  agrees. Deterministic and single-threaded. */
class LaserSlam {
  public:
    explicit LaserSlam(const LaserOptions& options);
    ~LaserSlam();
    LaserSlam(const LaserSlam&) = delete;
    LaserSlam& operator=(const LaserSlam&) = delete;

    /** \param odometry where the wheels tell that the robot is at the scan's stamp, in a frame of
     *         their own; nothing: motion is carried on as between the scans before */
    TrackedScan add(const PlanarScan& scan, const std::optional<PlanarPose>& odometry);

    /** Aligns neighboring keyscans of different passes and optimizes all poses. */
    void finish();

    const std::vector<TrackedScan>& scans() const;
    const std::vector<Keyscan>& keyscans() const;
    /** Relative poses between keyscans, as optimized. */
    const std::vector<PoseEdge>& edges() const;
    /** In the world of the first scan, after all corrections. */
    PlanarPose poseOf(const TrackedScan& scan) const;
    /** Loops that were found and not accepted, or dropped as contradicted by the rest. */
    std::size_t rejectedLoops() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
