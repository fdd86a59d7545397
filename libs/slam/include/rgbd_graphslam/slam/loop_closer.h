/** Places seen before: loops between keyframes, and frames that have lost their way. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/slam/local_mapper.h"
#include "rgbd_graphslam/slam/place_index.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

class LoopCloser {
  public:
    /** All arguments must outlive the closer. */
    LoopCloser(const SlamOptions& options, const Camera& camera, SlamMap& map);

    /** Takes up the keyframes of a map that was kept, and its loops. */
    void restore(std::vector<PoseEdge> loops);

    /** What coming keyframes depend on; not between findLoops() and correct(). */
    void save(ByteWriter& out) const;
    /** The map must be loaded. \throws DamagedBytes */
    void load(ByteReader& in);

    const std::vector<PoseEdge>& loops() const { return loops_; }

    /** Compares a keyframe with all earlier ones and remembers it. Verified loops join poseGraph().
     *  \return edges from the earlier keyframe to this one */
    std::vector<PoseEdge> findLoops(int keyframe);

    /** Finds a frame anywhere in the map, without any idea of its pose. */
    std::optional<LocatedFrame> relocalise(const Frame& frame, Tracker& tracker) const;

    /** Relative pose of two successive keyframes, with the information of the landmarks that both
     *  see; next to none where the camera lost its way between them. */
    PoseEdge odometryEdge(int keyframe) const;

    PoseGraph poseGraph() const;

    /** Moves keyframes, and landmarks with the keyframe that saw them last; then fuses what the
     * loops since the last call brought together. */
    void correct(const std::vector<SE3>& T_world_keyframe, LocalMapper& mapper);

  private:
    /** How far two poses are apart. */
    struct Drift {
        double m = 0, rad = 0;
    };
    /** Between parts of the map. */
    static constexpr Drift anything{1e6, 1e6};
    struct Loop {
        PoseEdge edge;
        /** What it asked of the map when it was found. */
        Drift asked;
        /** Landmark of the earlier place that each keypoint of the later keyframe shows. */
        std::vector<int> seen_again;
        /** All landmarks of the earlier place. */
        std::vector<int> landmarks;
    };
    void travelTo(int keyframe);
    void forgetCulled();
    double pathLength(int from, int to) const;
    Drift greatestDrift(int from, int to) const;
    Drift asked(const PoseEdge& loop) const;
    bool mightSee(int keyframe, int candidate) const;
    std::vector<Descriptor> placeDescriptors(int keyframe) const;
    int firstTooNear(int keyframe) const;
    std::vector<int> candidatesFor(int keyframe) const;
    std::optional<LocatedFrame> align(const Frame& frame, int candidate) const;
    std::optional<Loop> verify(int keyframe, int candidate);
    std::optional<Loop> likeliest(std::vector<Loop> loops) const;
    bool followed(const Loop& loop) const;
    void forget(const PoseEdge& edge);
    void fuse(const Loop& loop, LocalMapper& mapper);
    Matrix6d informationOf(int keyframe, const std::vector<int>& landmarks) const;
    std::vector<int> sharedLandmarks(int keyframe, int other) const;

    const SlamOptions& options_;
    const Camera& camera_;
    SlamMap& map_;
    PlaceIndex index_;
    Tracker verifier_;
    /** Length of the path up to each keyframe, m. */
    std::vector<double> travelled_m_;
    /** How many of the map's culled keyframes the index has forgotten. */
    std::size_t forgotten_ = 0;
    std::vector<PoseEdge> loops_;
    std::vector<Loop> unfused_;
};

}  // namespace rgbd_graphslam
