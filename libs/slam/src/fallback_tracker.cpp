#include "fallback_tracker.h"

#include <algorithm>

#include "keyframe_decision.h"
#include "rgbd_graphslam/core/free_memory.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/matcher.h"

namespace rgbd_graphslam {
namespace {

/** Of the points that an anchor had at best; with fewer the next frame follows another. */
constexpr double anchor_share = 0.5;
/** Keypoints of the frame before that are looked for, and the share that must be found again. */
constexpr std::size_t most_compared = 250;
constexpr double least_same = 0.1;
constexpr int same_hamming = 64;
constexpr float same_ratio = 0.85f;

}  // namespace

void FallbackTracker::restart(const Frame& frame, const std::optional<SE3>& T_last_cam) {
    odometry_.restart(frame, T_last_cam.value_or(SE3()));
    prior_.restart(frame, T_last_cam);
    anchor_.reset();
    before_.reset();
    unseen_frames_ = 0;
}

MotionPrior FallbackTracker::priorAt(const Frame& frame) const {
    MotionPrior prior = prior_;
    prior.advance(frame, guess(frame), MotionPrior::Source::Inertia);
    return prior;
}

MotionPrior FallbackTracker::priorByInertia(const Frame& frame) const {
    MotionPrior prior = prior_;
    prior.advance(frame, inertia(frame), MotionPrior::Source::InertiaAlone);
    return prior;
}

std::optional<SE3> FallbackTracker::follow(const Frame& frame, const SE3& T_last_world) {
    deceived_ = false;
    auto T_last_cam = followAnchor(frame, T_last_world);
    if (T_last_cam) {
        odometry_.restart(frame, *T_last_cam);
    } else {
        const auto possible = [&](const SE3& motion) {
            const bool ruled_out = prior_.rulesOut(frame, motion);
            deceived_ |= ruled_out;
            return !ruled_out;
        };
        T_last_cam = odometry_.follow(frame, possible);
    }
    prior_.advance(frame, T_last_cam.value_or(SE3()),
                   T_last_cam ? MotionPrior::Source::Images : MotionPrior::Source::None);
    return T_last_cam;
}

/** By the points of one earlier frame. */
std::optional<SE3> FallbackTracker::followAnchor(const Frame& frame, const SE3& T_last_world) {
    if (!anchor_) anchor_.emplace(Anchor{tracker_});
    const auto followed =
        anchor_->tracker.followLast(frame, odometry_.guess(frame).inverse() * T_last_world);
    if (!followed) {
        anchor_.reset();
        return std::nullopt;
    }
    const SE3 T_last_cam = T_last_world * followed->T_cam_world.inverse();
    if (prior_.rulesOut(frame, T_last_cam)) {
        deceived_ = true;
        anchor_.reset();
        return std::nullopt;
    }
    anchor_->most_inliers = std::max(anchor_->most_inliers, followed->inliers);
    if (followed->inliers < anchor_share * anchor_->most_inliers) anchor_.reset();
    return T_last_cam;
}

bool FallbackTracker::shouldStartSubmap(const Frame& frame, bool soon) {
    if (keypointsWithDepth(frame) < options_.fewest_keypoints) return false;
    const bool counts = unseen_frames_ == 0 || (!deceived_ && showsSceneBefore(frame));
    before_ = frame;
    freeMemory(before_->patches);
    before_->view = {};
    unseen_frames_ += counts;
    return counts && unseen_frames_ >=
                         (soon ? options_.dead_reckoned_keyframe_after : options_.new_submap_after);
}

/** Corners that noise makes are others in the next frame. */
bool FallbackTracker::showsSceneBefore(const Frame& frame) const {
    if (!before_) return true;
    std::vector<Descriptor> sample;
    const std::size_t every = 1 + before_->descriptors.size() / most_compared;
    for (std::size_t i = 0; i < before_->descriptors.size(); i += every) {
        sample.push_back(before_->descriptors[i]);
    }
    const auto same = matchMutually(sample, frame.descriptors, same_hamming, same_ratio);
    return static_cast<double>(same.size()) >= least_same * static_cast<double>(sample.size());
}

void FallbackTracker::save(ByteWriter& out) const {
    odometry_.save(out);
    prior_.save(out);
    putFlag(anchor_.has_value(), out);
    if (anchor_) {
        anchor_->tracker.save(out);
        out.put<std::int32_t>(anchor_->most_inliers);
    }
    out.put<std::int32_t>(unseen_frames_);
    putFlag(before_.has_value(), out);
    if (before_) put(*before_, out);
}

void FallbackTracker::load(ByteReader& in, const RigCameras& cameras, const Camera& view_camera,
                           int levels) {
    odometry_.load(in, view_camera);
    prior_.load(in);
    anchor_.reset();
    if (getFlag(in)) {
        anchor_.emplace(Anchor{tracker_});
        anchor_->tracker.load(in);
        anchor_->most_inliers = in.get<std::int32_t>();
    }
    unseen_frames_ = getTally(in);
    before_.reset();
    if (getFlag(in)) before_ = getFrame(in, cameras, levels);
}

}  // namespace rgbd_graphslam
