/** What drift on the way round can explain, and what it cannot. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** How far two poses are apart. */
struct Drift {
    double m = 0, rad = 0;
};

/** A place seen again that geometry has confirmed. */
struct VerifiedLoop {
    /** From the earlier keyframe to the later one. */
    PoseEdge edge;
    /** What it asked of the map when it was found. */
    Drift asked;
    /** Landmark of the earlier place that each keypoint of the later keyframe shows. */
    std::vector<int> seen_again;
    /** All landmarks of the earlier place. */
    std::vector<int> landmarks;
};

/** Bounds the drift between two keyframes by a share of the path between them, and judges loops by
 *  it. */
class LoopPlausibility {
  public:
    /** All arguments must outlive it. \param loops closed so far: short cuts of the path */
    LoopPlausibility(const LoopOptions& options, const SlamMap& map,
                     const std::vector<PoseEdge>& loops)
        : options_(options), map_(map), loops_(loops) {}

    /** Brings the odometer up to a keyframe, which comes before any question about it. */
    void travelTo(int keyframe);

    /** Whether a keyframe can share a view with a candidate if the map errs as much as it may. */
    bool mightSee(int keyframe, int candidate) const;

    /** What a loop asks of the map as it is: how far its later keyframe would have to move. */
    Drift asked(const PoseEdge& loop) const;

    /** Of places that look alike, the one that asks for least drift among those with many inliers;
     *  none when even that is more than the path explains. */
    std::optional<VerifiedLoop> likeliest(std::vector<VerifiedLoop> loops) const;

    /** Whether the optimized map does as a loop asked. One that the robust graph left unheeded
     *  contradicts all the others. */
    bool followed(const VerifiedLoop& loop) const;

    /** What coming keyframes depend on. */
    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    double pathLength(int from, int to) const;
    Drift greatestDrift(int from, int to) const;

    const LoopOptions& options_;
    const SlamMap& map_;
    const std::vector<PoseEdge>& loops_;
    /** Length of the path up to each keyframe, m. */
    std::vector<double> travelled_m_;
};

}  // namespace rgbd_graphslam
