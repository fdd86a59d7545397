#include "rgbd_graphslam/slam/visual_slam.h"

#include "visual_slam_implementation.h"

namespace rgbd_graphslam {
namespace {

constexpr int final_iterations = 10;

}  // namespace

const char* toString(FrameOrigin origin) {
    switch (origin) {
        case FrameOrigin::Tracked:
            return "tracked";
        case FrameOrigin::Recovered:
            return "recovered";
        case FrameOrigin::DeadReckoned:
            return "dead_reckoned";
        case FrameOrigin::Uncertain:
            return "uncertain";
        case FrameOrigin::Lost:
            break;
    }
    return "lost";
}

VisualSlam::VisualSlam(const SlamOptions& options, const Camera& camera)
    : impl_(std::make_unique<Implementation>(options, camera)) {}

VisualSlam::VisualSlam(const SlamOptions& options, const Camera& camera, MapSnapshot map,
                       MapUse use)
    : VisualSlam(options, camera) {
    impl_->restore(std::move(map), use);
}

VisualSlam::~VisualSlam() = default;

Frame VisualSlam::prepare(const RgbdImage& image) const {
    Frame frame;
    impl_->times.measure("extract", [&] { frame = impl_->builder.build(image); });
    return frame;
}

TrackedFrame VisualSlam::track(Frame frame) {
    return impl_->track(std::move(frame));
}

PoseEdge VisualSlam::odometryEdge(int keyframe) const {
    return impl_->edges.odometry(keyframe);
}

std::vector<PoseEdge> VisualSlam::findLoops(int keyframe) {
    std::vector<PoseEdge> loops;
    if (!impl_->options.loops.enabled) return loops;
    impl_->times.measure("find-loops", [&] { loops = impl_->closer.findLoops(keyframe); });
    // What comes next asks where keyframes are, and adjusts everything anew.
    if (!loops.empty()) impl_->applyPendingAdjustments();
    for (const PoseEdge& loop : loops) {
        impl_->join(loop);
        impl_->uncertainty.closeLoop(loop.from, loop.to);
    }
    return loops;
}

PoseGraph VisualSlam::poseGraph() const {
    return impl_->edges.graph(impl_->closer.loops());
}

std::vector<std::pair<int, int>> VisualSlam::covisibility() const {
    return impl_->edges.covisiblePairs();
}

void VisualSlam::correct(const std::vector<SE3>& T_world_keyframe) {
    impl_->applyPendingAdjustment();
    bool closed = false;
    impl_->times.measure("correct",
                         [&] { closed = impl_->closer.correct(T_world_keyframe, impl_->mapper); });
    if (!closed || !impl_->options.mapper.loop_adjustment) return;
    impl_->global_bundle_adjuster.start(impl_->options.mapper.loop_iterations);
    impl_->frames_since_loop = 0;
}

void VisualSlam::finish() {
    impl_->applyPendingAdjustments();
    if (!impl_->options.mapper.final_adjustment) return;
    impl_->times.measure("final-adjustment",
                         [&] { impl_->global_bundle_adjuster.adjustNow(final_iterations); });
}

std::vector<TrackedFrame> VisualSlam::frames() const {
    return impl_->records.views(impl_->map, impl_->uncertainty);
}

std::vector<KeyframeView> VisualSlam::keyframes() const {
    std::vector<KeyframeView> views;
    for (const Keyframe& keyframe : impl_->map.keyframes()) {
        views.push_back({keyframe.id, keyframe.frame.stamp_s,
                         impl_->map.T_cam_world(keyframe.id).inverse(), keyframe.culled,
                         keyframe.submap});
    }
    return views;
}

std::vector<LandmarkView> VisualSlam::landmarks() const {
    std::vector<LandmarkView> views;
    for (const Landmark& landmark : impl_->map.landmarks()) {
        if (!landmark.alive) continue;
        views.push_back({landmark.position, static_cast<int>(landmark.observations.size())});
    }
    return views;
}

MapSnapshot VisualSlam::snapshot() const {
    return takeSnapshot(impl_->map, impl_->camera, impl_->options.features.scale_factor,
                        impl_->closer.loops());
}

const std::vector<PoseEdge>& VisualSlam::loops() const {
    return impl_->closer.loops();
}

std::vector<FeatureView> VisualSlam::features() const {
    return impl_->tracker.features();
}

void VisualSlam::save(ByteWriter& out) const {
    impl_->save(out);
}

void VisualSlam::load(ByteReader& in) {
    impl_->load(in);
}

std::vector<VisualSlam::StageTime> VisualSlam::stageTimes() const {
    return impl_->times.all();
}

}  // namespace rgbd_graphslam
