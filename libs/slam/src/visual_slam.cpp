#include "rgbd_graphslam/slam/visual_slam.h"

#include <algorithm>
#include <cmath>

#include "keyframe_decision.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/features/frame_builder.h"
#include "rgbd_graphslam/slam/local_mapper.h"
#include "rgbd_graphslam/slam/loop_closer.h"
#include "rgbd_graphslam/slam/stage_times.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_first_landmarks = 50;
constexpr int final_iterations = 10;

/** A frame as it is kept: tied to a keyframe, so that it moves with the map. */
struct FrameRecord {
    double stamp_s = 0;
    FrameOrigin origin = FrameOrigin::Lost;
    int inliers = 0;
    int reference_keyframe = 0;
    SE3 T_cam_reference;
    std::optional<int> keyframe;
};

std::string pyramidText(int levels, double scale_factor) {
    return std::to_string(levels) + " pyramid levels of factor " + std::to_string(scale_factor);
}

void checkFits(const MapSnapshot& map, const FeatureOptions& features, const Camera& camera,
               MapUse use) {
    if (map.levels != features.levels || map.scale_factor != features.scale_factor) {
        throw Error("the map was made with " + pyramidText(map.levels, map.scale_factor) +
                        ", the settings have " +
                        pyramidText(features.levels, features.scale_factor),
                    "use the config.ini of the map's folder");
    }
    const bool same_camera = map.camera.width == camera.width &&
                             map.camera.height == camera.height && map.camera.fx == camera.fx &&
                             map.camera.fy == camera.fy && map.camera.cx == camera.cx &&
                             map.camera.cy == camera.cy;
    if (use == MapUse::Extend && !same_camera) {
        throw Error("the map was made by a camera of another calibration, so it cannot be extended",
                    "localise in it, or make both rawlogs with one calibration");
    }
}

}  // namespace

const char* toString(FrameOrigin origin) {
    switch (origin) {
        case FrameOrigin::Tracked:
            return "tracked";
        case FrameOrigin::Recovered:
            return "recovered";
        case FrameOrigin::Lost:
            break;
    }
    return "lost";
}

class VisualSlam::Implementation {
  public:
    Implementation(const SlamOptions& slam_options, const Camera& slam_camera)
        : options(slam_options),
          camera(slam_camera),
          builder(options.features, camera),
          map(options.features.scale_factor, options.features.levels),
          tracker(options, camera, map),
          mapper(options, camera, map),
          closer(options, camera, map),
          decision(options.keyframes) {}

    void restore(MapSnapshot snapshot, MapUse use);
    TrackedFrame track(Frame frame);
    TrackedFrame view(const FrameRecord& record) const;
    void handOver();

    const SlamOptions options;
    const Camera camera;
    const FrameBuilder builder;
    SlamMap map;
    Tracker tracker;
    LocalMapper mapper;
    LoopCloser closer;
    KeyframeDecision decision;
    std::vector<FrameRecord> records;
    int frames_since_keyframe = 0;
    /** The map may not change. */
    bool frozen = false;
    /** Whether the way from the last keyframe was measured throughout. */
    bool unbroken = true;
    mutable StageTimes times;

  private:
    void start(Frame frame, FrameRecord& record);
    void locate(Frame frame, FrameRecord& record);
    int insertKeyframe(const Frame& frame, const LocatedFrame& located, int part);
};

void VisualSlam::Implementation::restore(MapSnapshot snapshot, MapUse use) {
    checkFits(snapshot, options.features, camera, use);
    map.restore(std::move(snapshot.keyframes), std::move(snapshot.landmarks));
    times.measure("place-index", [&] { closer.restore(std::move(snapshot.loops)); });
    decision.reset(map.keyframes().back());
    frozen = use == MapUse::Localise;
    unbroken = false;
}

TrackedFrame VisualSlam::Implementation::track(Frame frame) {
    if (!records.empty() && frame.stamp_s <= records.back().stamp_s) {
        throw Error("frame at " + std::to_string(frame.stamp_s) +
                        " s is not later than the last, " + std::to_string(records.back().stamp_s) +
                        " s",
                    "leave it out or sort the frames");
    }
    ++frames_since_keyframe;
    if (mapper.pending() && frames_since_keyframe >= options.mapper.hand_over_frames) handOver();
    FrameRecord record;
    record.stamp_s = frame.stamp_s;
    if (map.keyframes().empty()) {
        start(std::move(frame), record);
    } else {
        locate(std::move(frame), record);
    }
    records.push_back(record);
    return view(record);
}

/** The first frame with enough depth becomes the origin of the world. */
void VisualSlam::Implementation::start(Frame frame, FrameRecord& record) {
    const auto has_depth = [](const Keypoint& k) { return k.depth_m > 0; };
    const auto& keypoints = frame.keypoints;
    if (std::count_if(keypoints.begin(), keypoints.end(), has_depth) < fewest_first_landmarks)
        return;
    LocatedFrame located;
    located.landmarks.assign(keypoints.size(), no_landmark);
    const int id = insertKeyframe(frame, located, 0);
    located.landmarks = map.keyframe(id).landmarks;
    record.origin = FrameOrigin::Tracked;
    record.keyframe = id;
    record.inliers = static_cast<int>(map.aliveLandmarks());
    tracker.setLast(std::move(frame), std::move(located), id, false);
}

void VisualSlam::Implementation::locate(Frame frame, FrameRecord& record) {
    std::optional<LocatedFrame> located;
    times.measure("track", [&] { located = tracker.track(frame); });
    record.origin = FrameOrigin::Tracked;
    if (!located) {
        handOver();
        times.measure("relocalise", [&] { located = closer.relocalise(frame, tracker); });
        record.origin = located ? FrameOrigin::Recovered : FrameOrigin::Lost;
        tracker.forget();
        unbroken = false;
    }
    if (!located) {
        if (records.empty()) return;
        record.reference_keyframe = records.back().reference_keyframe;
        record.T_cam_reference = records.back().T_cam_reference;
        return;
    }
    int reference = map.observers(located->landmarks).front().keyframe;
    if (!frozen && decision.wants(map, *located, frames_since_keyframe)) {
        handOver();
        reference = insertKeyframe(frame, *located, map.keyframe(reference).part);
        record.keyframe = reference;
        located->landmarks = map.keyframe(reference).landmarks;
    }
    record.inliers = located->inliers;
    record.reference_keyframe = reference;
    record.T_cam_reference = located->T_cam_world * map.T_cam_world(reference).inverse();
    tracker.setLast(std::move(frame), std::move(*located), reference, true);
}

int VisualSlam::Implementation::insertKeyframe(const Frame& frame, const LocatedFrame& located,
                                               int part) {
    int id = 0;
    times.measure("map", [&] {
        id = map.addKeyframe(frame, located.T_cam_world, part, unbroken);
        for (std::size_t i = 0; i < located.landmarks.size(); ++i) {
            if (located.landmarks[i] == no_landmark) continue;
            map.addObservation(located.landmarks[i], id, static_cast<int>(i));
        }
        mapper.insert(id);
    });
    decision.reset(map.keyframe(id));
    frames_since_keyframe = 0;
    unbroken = true;
    return id;
}

void VisualSlam::Implementation::handOver() {
    if (!mapper.pending()) return;
    double adjustment_ms = 0;
    times.measure("hand-over", [&] { adjustment_ms = mapper.handOver(); });
    times.add("local-adjustment", adjustment_ms, adjustment_ms);
}

TrackedFrame VisualSlam::Implementation::view(const FrameRecord& record) const {
    TrackedFrame frame;
    frame.stamp_s = record.stamp_s;
    frame.origin = record.origin;
    frame.inliers = record.inliers;
    frame.reference_keyframe = record.reference_keyframe;
    frame.keyframe = record.keyframe;
    frame.T_reference_cam = record.T_cam_reference.inverse();
    if (map.keyframes().empty()) return frame;
    frame.T_world_cam =
        (record.T_cam_reference * map.T_cam_world(record.reference_keyframe)).inverse();
    return frame;
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
    return impl_->closer.odometryEdge(keyframe);
}

std::vector<PoseEdge> VisualSlam::findLoops(int keyframe) {
    std::vector<PoseEdge> loops;
    if (!impl_->options.loops.enabled) return loops;
    impl_->times.measure("find-loops", [&] { loops = impl_->closer.findLoops(keyframe); });
    return loops;
}

PoseGraph VisualSlam::poseGraph() const {
    return impl_->closer.poseGraph();
}

void VisualSlam::correct(const std::vector<SE3>& T_world_keyframe) {
    impl_->handOver();
    impl_->times.measure("correct",
                         [&] { impl_->closer.correct(T_world_keyframe, impl_->mapper); });
}

void VisualSlam::finish() {
    impl_->handOver();
    if (impl_->frozen || !impl_->options.mapper.final_adjustment) return;
    impl_->times.measure("final-adjustment", [&] { impl_->mapper.adjustAll(final_iterations); });
}

std::vector<TrackedFrame> VisualSlam::frames() const {
    std::vector<TrackedFrame> frames;
    for (const FrameRecord& record : impl_->records) frames.push_back(impl_->view(record));
    return frames;
}

std::vector<KeyframeView> VisualSlam::keyframes() const {
    std::vector<KeyframeView> views;
    for (const Keyframe& keyframe : impl_->map.keyframes()) {
        views.push_back({keyframe.id, keyframe.frame.stamp_s,
                         impl_->map.T_cam_world(keyframe.id).inverse(), keyframe.culled});
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

std::vector<VisualSlam::StageTime> VisualSlam::stageTimes() const {
    return impl_->times.all();
}

}  // namespace rgbd_graphslam
