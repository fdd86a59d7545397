/** What can be known of frames that do not see the map. */
#pragma once
#include <optional>

#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/tracker.h"
#include "rgbd_graphslam/slam/weak_tracker.h"

namespace rgbd_graphslam {

/** Follows the camera by the points of one frame for as long as it can, so that errors do not add
 * up from frame to frame, and else by WeakTracker. Says when the map should begin anew. */
class WeakMotion {
  public:
    /** Both arguments must outlive this.
     *  \param tracker whose last frame will be followed */
    WeakMotion(const RecoveryOptions& options, const Tracker& tracker)
        : options_(options), tracker_(tracker) {}

    /** The map is seen, or begins, at a frame.
     *  \param T_last_cam motion since the frame before, as a first guess for the next one */
    void restart(const Frame& frame, const SE3& T_last_cam);

    /** \param T_last_world pose of the frame before
     *  \return T_last_cam, the motion since then; nothing when no means works */
    std::optional<SE3> follow(const Frame& frame, const SE3& T_last_world);

    /** To be asked once about each frame since the map was seen.
     *  \param soon few frames prove enough, as their motion is known or no map was seen before
     *  \return whether the map should go on from this frame: it is rich enough for a keyframe, and
     *          so were enough frames before it */
    bool shouldBeginAnew(const Frame& frame, bool soon);

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** The tracker must be loaded.
     *  \param view_camera of the frames' small images
     *  \throws DamagedBytes */
    void load(ByteReader& in, const Camera& view_camera);

  private:
    /** A tracker whose last frame is the one that is followed. */
    struct Anchor {
        Tracker tracker;
        int most_inliers = 0;
    };

    const RecoveryOptions& options_;
    const Tracker& tracker_;
    WeakTracker weak_;
    std::optional<Anchor> anchor_;
    /** Frames since the map was seen that could have gone on with it. */
    int astray_ = 0;
};

}  // namespace rgbd_graphslam
