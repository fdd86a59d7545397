/** Places seen before: loops between keyframes, and frames that have lost their way. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/slam/local_mapper.h"
#include "rgbd_graphslam/slam/loop_plausibility.h"
#include "rgbd_graphslam/slam/place_index.h"
#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Finds and verifies the places of keyframes and of lost frames in the map. */
class LoopCloser {
  public:
    /** All arguments must outlive the closer. */
    LoopCloser(const SlamOptions& options, const RigCameras& cameras, SlamMap& map);
    LoopCloser(const LoopCloser&) = delete;
    LoopCloser& operator=(const LoopCloser&) = delete;

    /** Takes up the keyframes of a map that was kept, and its loops. */
    void restore(std::vector<PoseEdge> loops);

    /** What coming keyframes depend on; not between findLoops() and correct(). */
    void save(ByteWriter& out) const;
    /** The map must be loaded. \throws DamagedBytes */
    void load(ByteReader& in);

    const std::vector<PoseEdge>& loops() const { return loops_; }

    /** Compares a keyframe with all earlier ones and remembers it. Verified loops join loops().
     *  \return edges from the earlier keyframe to this one */
    std::vector<PoseEdge> findLoops(int keyframe);

    /** Living keyframes anywhere in the map that look like a frame, the likeliest first. */
    std::vector<int> placesLike(const Frame& frame, int most) const;

    /** Moves keyframes, and landmarks with the keyframe that saw them last; then fuses what the
     *  loops since the last call brought together.
     *  \return whether there was such a loop, not only ones that the graph left unheeded */
    bool correct(const std::vector<SE3>& T_world_keyframe, LocalMapper& mapper);

  private:
    void forgetCulled();
    std::vector<Descriptor> placeDescriptors(int keyframe) const;
    int firstTooNear(int keyframe) const;
    std::vector<int> candidatesFor(int keyframe) const;
    std::optional<VerifiedLoop> verify(int keyframe, int candidate);
    void forget(const PoseEdge& edge);
    void fuse(const VerifiedLoop& loop, LocalMapper& mapper);

    const SlamOptions& options_;
    const RigCameras& cameras_;
    SlamMap& map_;
    std::vector<PoseEdge> loops_;
    LoopPlausibility plausibility_;
    PlaceIndex index_;
    Tracker verifier_;
    /** How many of the map's culled keyframes the index has forgotten. */
    std::size_t forgotten_ = 0;
    std::vector<VerifiedLoop> unfused_;
};

}  // namespace rgbd_graphslam
