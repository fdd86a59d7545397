#include "weak_motion.h"

#include <algorithm>

#include "keyframe_decision.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Of the points that an anchor had at best; with fewer the next frame follows another. */
constexpr double anchor_share = 0.5;

}  // namespace

void WeakMotion::restart(const Frame& frame, const SE3& T_last_cam) {
    weak_.restart(frame, T_last_cam);
    anchor_.reset();
    astray_ = 0;
}

std::optional<SE3> WeakMotion::follow(const Frame& frame, const SE3& T_last_world) {
    if (!anchor_) anchor_.emplace(Anchor{tracker_});
    const auto followed =
        anchor_->tracker.followLast(frame, weak_.guess(frame).inverse() * T_last_world);
    if (!followed) {
        anchor_.reset();
        return weak_.follow(frame);
    }
    anchor_->most_inliers = std::max(anchor_->most_inliers, followed->inliers);
    if (followed->inliers < anchor_share * anchor_->most_inliers) anchor_.reset();
    const SE3 T_last_cam = T_last_world * followed->T_cam_world.inverse();
    weak_.restart(frame, T_last_cam);
    return T_last_cam;
}

bool WeakMotion::shouldBeginAnew(const Frame& frame, bool soon) {
    if (keypointsWithDepth(frame) < options_.fewest_keypoints) return false;
    ++astray_;
    return astray_ >= (soon ? options_.weak_keyframe_after : options_.new_part_after);
}

void WeakMotion::save(ByteWriter& out) const {
    weak_.save(out);
    putFlag(anchor_.has_value(), out);
    if (anchor_) {
        anchor_->tracker.save(out);
        out.put<std::int32_t>(anchor_->most_inliers);
    }
    out.put<std::int32_t>(astray_);
}

void WeakMotion::load(ByteReader& in, const Camera& view_camera) {
    weak_.load(in, view_camera);
    anchor_.reset();
    if (getFlag(in)) {
        anchor_.emplace(Anchor{tracker_});
        anchor_->tracker.load(in);
        anchor_->most_inliers = in.get<std::int32_t>();
    }
    astray_ = getTally(in);
}

}  // namespace rgbd_graphslam
