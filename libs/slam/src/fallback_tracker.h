/** What can be known of frames that do not see the map. */
#pragma once
#include <optional>

#include "motion_prior.h"
#include "rgbd_graphslam/slam/dense_odometry.h"
#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

/** Follows the camera by the points of one frame for as long as it can, so that errors do not add
 * up from frame to frame, and else by DenseOdometry. Says when a submap should start. */
class FallbackTracker {
  public:
    /** Both arguments must outlive this.
     *  \param tracker whose last frame will be followed */
    FallbackTracker(const RecoveryOptions& options, const Tracker& tracker)
        : options_(options), tracker_(tracker) {}

    /** The map is seen, or begins, at a frame.
     *  \param T_last_cam motion since the frame before, as a first guess for the next one; nothing
     *         where the camera is found again or begins, perhaps moving */
    void restart(const Frame& frame, const std::optional<SE3>& T_last_cam);

    /** The likeliest T_last_cam before the frame is looked at. */
    SE3 guess(const Frame& frame) const { return odometry_.guess(frame); }

    /** The map is seen, but not surely: the motion counts as measured by images. */
    void goOn(const Frame& frame, const SE3& T_last_cam) {
        odometry_.restart(frame, T_last_cam);
        prior_.advance(frame, T_last_cam, MotionPrior::Source::Images);
    }

    /** Of the last frame. */
    const MotionPrior& prior() const { return prior_; }

    /** How uncertain the pose by guess() is. */
    MotionPrior priorAt(const Frame& frame) const;

    /** The same without wheels and gyroscope: what hands and bodies can do. */
    SE3 inertia(const Frame& frame) const { return odometry_.inertia(frame); }
    MotionPrior priorByInertia(const Frame& frame) const;

    /** \param T_last_world pose of the frame before
     *  \return T_last_cam, the motion since then; nothing when no means works */
    std::optional<SE3> follow(const Frame& frame, const SE3& T_last_world);

    /** A frame that the map did not locate, and that follow() was not asked about. */
    void miss(const Frame& frame) { prior_.advance(frame, SE3(), MotionPrior::Source::None); }

    /** To be asked once about each frame since the map was seen.
     *  \param soon few frames prove enough, as their motion is known or no map was seen before
     *  \return whether the map should go on from this frame: it is rich enough for a keyframe, and
     *          so were enough frames before it, which show the same scene, as noise does not,
     * moving as the camera does, as what sticks to the lens does not */
    bool shouldStartSubmap(const Frame& frame, bool soon);

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** The tracker must be loaded.
     *  \param view_camera of the frames' small images
     *  \param levels of the image pyramid
     *  \throws DamagedBytes */
    void load(ByteReader& in, const RigCameras& cameras, const Camera& view_camera, int levels);

  private:
    /** A tracker whose last frame is the one that is followed. */
    struct Anchor {
        Tracker tracker;
        int most_inliers = 0;
    };

    std::optional<SE3> followAnchor(const Frame& frame, const SE3& T_last_world);
    bool showsSceneBefore(const Frame& frame) const;

    const RecoveryOptions& options_;
    const Tracker& tracker_;
    DenseOdometry odometry_;
    MotionPrior prior_;
    std::optional<Anchor> anchor_;
    /** Frames since the map was seen that could have gone on with it. */
    int unseen_frames_ = 0;
    /** The last one of them. */
    std::optional<Frame> before_;
    /** Whether wheels or gyroscope rule out what the frame at hand seems to show. */
    bool deceived_ = false;
};

}  // namespace rgbd_graphslam
