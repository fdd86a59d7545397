/** Where a frame is when no landmark can tell. */
#pragma once
#include <functional>
#include <future>
#include <optional>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/features/frame.h"

namespace rgbd_graphslam {

/** T_last_cam by the wheels; nothing where they are silent, or leap as when their driver starts
 *  again. */
std::optional<SE3> wheelMotion(const DeadReckoning& last, const DeadReckoning& now,
                               double passed_s);

/** Whether other sensors allow a motion T_last_cam. */
using PossibleMotion = std::function<bool(const SE3& T_last_cam)>;

/** Follows the camera from frame to frame by whole images, by the robot's odometry or by a
 * gyroscope, whichever comes first to work. The poses drift; they are a stopgap until places are
 * known again. */
class DenseOdometry {
  public:
    /** Begins again at a frame whose pose is known by better means.
     *  \param T_last_cam motion since the frame before, as a first guess for the next one */
    void restart(const Frame& frame, const SE3& T_last_cam);

    /** \return T_last_cam, the motion since the last frame that restart() or follow() knew; nothing
     *          when no means works, after which the next frame is tried against the same one
     *  \param possible asked about what images say, which something in front of the lens may fool
     */
    std::optional<SE3> follow(
        const Frame& frame, const PossibleMotion& possible = [](const SE3&) { return true; });

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** \param view_camera of the frames' small images
     *  \throws DamagedBytes */
    void load(ByteReader& in, const Camera& view_camera);

    /** The likeliest T_last_cam before the frame is looked at. */
    SE3 guess(const Frame& frame) const;

    /** The same if the camera moves on as it did, whatever other sensors say. */
    SE3 inertia(const Frame& frame) const;

  private:
    std::optional<SE3> predictedMotion(const Frame& frame) const;
    std::optional<SE3> alignWithAnchor(const Frame& frame, const SE3& T_last_cam_guess,
                                       const PossibleMotion& possible);
    bool gyroscopeServes(const Frame& frame) const;
    void accept(const Frame& frame, const SE3& T_last_cam);

    /** Frames are aligned with one anchor for as long as they share enough with it, so that small
     *  errors do not add up. */
    std::shared_future<DenseView> anchor_;
    SE3 T_anchor_last_;
    DeadReckoning last_reckoning_;
    double last_stamp_s_ = 0;
    /** When more than a gyroscope knew where the camera was. */
    double last_fixed_s_ = 0;
    SE3 motion_;  // T_last_cam of the last two frames
};

}  // namespace rgbd_graphslam
