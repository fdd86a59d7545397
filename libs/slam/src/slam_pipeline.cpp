#include "slam_pipeline.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "map_fit.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_first_landmarks = 50;
constexpr int final_iterations = 10;
/** Shared landmarks by which a keyframe passes on what is known of its pose. */
constexpr int fewest_that_tie = 15;
/** Frames between checks of whether the landmarks agree; every keyframe is checked. */
constexpr int check_interval_frames = 15;

}  // namespace

std::vector<FrameBuilder> SlamPipeline::buildersFor(const FeatureOptions& features,
                                                    const Rig& rig) {
    std::vector<FrameBuilder> builders;
    for (const RigCamera& camera : rig.cameras) builders.emplace_back(features, camera.model);
    return builders;
}

SlamOptions SlamPipeline::optionsFor(SlamOptions options, const Rig& rig) {
    options.sensor.disparity_m_px.clear();
    for (const RigCamera& camera : rig.cameras) {
        options.sensor.disparity_m_px.push_back(camera.disparity_m_px);
    }
    return options;
}

SlamPipeline::SlamPipeline(const SlamOptions& options, const Rig& rig)
    : options_(optionsFor(options, rig)),
      rig_(rig),
      cameras_(rig_),
      builders_(buildersFor(options_.features, rig_)),
      map_(options_.features.scale_factor, options_.features.levels),
      tracker_(options_, cameras_, map_),
      mapper_(options_, cameras_, map_),
      global_adjuster_(options_, cameras_, map_),
      closer_(options_, cameras_, map_),
      edges_(options_.sensor, cameras_, map_),
      fallback_(options_.recovery, tracker_),
      relocalizer_(options_, cameras_, map_, closer_, tracker_),
      movers_(cameras_),
      decision_(options_.keyframes),
      motion_(options_.motion, map_) {}

Frame SlamPipeline::prepare(const std::vector<CameraImage>& images) const {
    Frame frame;
    times_.measure("extract", [&] { frame = build(images); });
    return frame;
}

Frame SlamPipeline::build(const std::vector<CameraImage>& images) const {
    Frame frame;
    if (!images.empty()) frame.stamp_s = images.front().image.stamp_s;
    for (const CameraImage& image : images) {
        Frame seen = builders_.at(image.camera).build(image.image);
        if (image.camera == 0) {
            seen.stamp_s = frame.stamp_s;
            frame = std::move(seen);
        } else {
            append(std::move(seen), image.camera, frame);
        }
    }
    if (cameras_.count() > 1) frame.grid = cameras_.gridOf(frame.keypoints);
    return frame;
}

void SlamPipeline::restore(MapSnapshot snapshot, MapUse use) {
    requireFits(snapshot, options_.features, rig_, use);
    seeWith(rig_, snapshot);
    map_.restore(std::move(snapshot.keyframes), std::move(snapshot.landmarks));
    times_.measure("place-index", [&] { closer_.restore(std::move(snapshot.loops)); });
    decision_.reset(map_.keyframes().back());
    if (use == MapUse::Localize) map_.freeze();
    uncertainty_.restore(map_.keyframes().size());
    link_ = Link::None;
}

void SlamPipeline::save(ByteWriter& out) const {
    map_.save(out);
    tracker_.save(out);
    mapper_.save(out);
    global_adjuster_.save(out);
    closer_.save(out);
    fallback_.save(out);
    relocalizer_.save(out);
    movers_.save(out);
    decision_.save(out);
    trajectory_.save(out);
    motion_.save(out);
    uncertainty_.save(out);
    for (const int number : {frames_since_keyframe_, frames_since_loop_}) {
        out.put<std::int32_t>(number);
    }
    putFlag(initialized_, out);
    put(link_, out);
}

void SlamPipeline::load(ByteReader& in) {
    map_.load(in, cameras_);
    tracker_.load(in);
    mapper_.load(in);
    global_adjuster_.load(in);
    closer_.load(in);
    fallback_.load(in, cameras_, builders_.front().viewCamera(), map_.levels());
    relocalizer_.load(in);
    movers_.load(in, map_.keyframes().size());
    decision_.load(in, map_.keyframes().size());
    trajectory_.load(in, map_.keyframes().size());
    motion_.load(in);
    uncertainty_.load(in, map_.keyframes().size());
    for (int* number : {&frames_since_keyframe_, &frames_since_loop_}) {
        *number = getTally(in);
    }
    initialized_ = getFlag(in);
    link_ = getLink(in);
}

TrackedFrame SlamPipeline::track(Frame frame) {
    trajectory_.requireLater(frame.stamp_s);
    ++frames_since_keyframe_;
    ++frames_since_loop_;
    if (mapper_.pending() && frames_since_keyframe_ >= options_.mapper.adjustment_delay_frames)
        applyPendingAdjustment();
    if (frames_since_loop_ == options_.mapper.loop_adjustment_delay_frames)
        applyPendingAdjustments();
    times_.measure("motion", [&] { motion_.note(frame); });
    trajectory_.revise(motion_.takeRevised(), map_);
    FrameRecord record;
    record.stamp_s = frame.stamp_s;
    if (map_.keyframes().empty()) {
        start(std::move(frame), record);
    } else {
        auto located = locate(frame, record);
        if (located) {
            acceptTracked(std::move(frame), std::move(*located), record);
        } else {
            handleTrackingLoss(std::move(frame), record);
        }
    }
    trajectory_.add(record);
    return record.view(map_, uncertainty_);
}

/** The first frame with enough depth becomes the origin of the world. */
void SlamPipeline::start(Frame frame, FrameRecord& record) {
    if (keypointsWithDepth(frame) < fewest_first_landmarks) return;
    startSubmap(std::move(frame), record);
}

/** T_cam_world, after frames without sight of the map: while it is seen, the motion of the last
 *  frames predicts as well, and without the delay and noise of another sensor. Nothing without an
 *  inertial sensor whose biases are known. */
std::optional<SE3> SlamPipeline::predictedBySensors(const Frame& frame) const {
    if (!initialized_ || trajectory_.lastSawMap() || !motion_.predicted()) return std::nullopt;
    return fallback_.guess(frame).inverse() * trajectory_.lastPose(map_);
}

/** Nothing before any frame of this run has been located. */
std::optional<Prediction> SlamPipeline::prediction(const Frame& frame) const {
    if (!initialized_) return std::nullopt;
    const SE3 T_cam_world = fallback_.guess(frame).inverse() * trajectory_.lastPose(map_);
    return Prediction{T_cam_world, map_.keyframe(trajectory_.lastReference()).submap,
                      fallback_.priorAt(frame)};
}

/** \param record its origin tells how far the pose is believed, or that it is doubted altogether */
std::optional<LocatedFrame> SlamPipeline::trackBelievably(Frame& frame, FrameRecord& record) {
    record.origin = FrameOrigin::Lost;
    const std::vector<Keypoint> keypoints = frame.keypoints;
    auto located = tracker_.track(frame, predictedBySensors(frame));
    if (!located) return located;
    record.origin = FrameOrigin::Tracked;
    holdStill(frame, *located);
    if (!initialized_) return located;
    const SE3 T_last_cam = trajectory_.lastPose(map_) * located->T_cam_world.inverse();
    const Verdict verdict =
        judge(*located, {fallback_.guess(frame).inverse() * T_last_cam, fallback_.priorAt(frame)},
              {fallback_.inertia(frame).inverse() * T_last_cam, fallback_.priorByInertia(frame)});
    if (verdict == Verdict::Believed) return located;
    record.origin = FrameOrigin::Uncertain;
    if (verdict == Verdict::Uncertain) return located;
    frame.keypoints = keypoints;
    return std::nullopt;
}

/** The pose of a keyframe that the camera still stands at, whatever depth noise and movers say. */
void SlamPipeline::holdStill(const Frame& frame, LocatedFrame& located) const {
    if (!options_.tracker.detect_standstill) return;
    const int nearest = map_.observers(located.landmarks).front().keyframe;
    const Keyframe& keyframe = map_.keyframe(nearest);
    if (standsAt(keyframe, frame, located.landmarks, map_, cameras_))
        located.T_cam_world = keyframe.T_cam_world;
}

/** A pose that rests mostly on movers is not believed. */
void SlamPipeline::removeMovers(Frame& frame, LocatedFrame& located, FrameRecord& record) {
    const bool believed = record.origin == FrameOrigin::Tracked && frame.view.valid();
    if (!options_.tracker.mask_moving || !believed) return;
    const int reference = map_.observers(located.landmarks).front().keyframe;
    const auto moving =
        movers_.moving(frame, located.T_cam_world, map_.keyframe(reference).submap, map_);
    if (!moving.empty()) {
        LocatedFrame fixed = located;
        Frame rest = frame;
        removeKeypoints(moving, cameras_, rest, fixed.landmarks);
        if (!tracker_.solveAgain(rest, fixed)) {
            record.origin = FrameOrigin::Uncertain;
            return;
        }
        frame = std::move(rest);
        located = std::move(fixed);
        holdStill(frame, located);
    }
    movers_.note(frame, located.T_cam_world, reference, map_);
}

std::optional<LocatedFrame> SlamPipeline::locate(Frame& frame, FrameRecord& record) {
    std::optional<LocatedFrame> located;
    times_.measure("track", [&] { located = trackBelievably(frame, record); });
    if (located) {
        times_.measure("movers", [&] { removeMovers(frame, *located, record); });
        return located;
    }
    applyPendingAdjustment();
    times_.measure("relocalize", [&] { located = relocalizer_.find(frame, prediction(frame)); });
    if (!located) return located;
    record.origin = FrameOrigin::Recovered;
    tracker_.forget();
    link_ = Link::None;
    return located;
}

void SlamPipeline::acceptTracked(Frame frame, LocatedFrame located, FrameRecord& record) {
    relocalizer_.forget();
    const SE3 T_last_cam =
        initialized_ ? trajectory_.lastPose(map_) * located.T_cam_world.inverse() : SE3();
    const bool believed = record.origin != FrameOrigin::Uncertain;
    if (believed) {
        const bool goes_on = initialized_ && record.origin == FrameOrigin::Tracked;
        fallback_.restart(frame, goes_on ? std::optional<SE3>(T_last_cam) : std::nullopt);
    } else {
        fallback_.goOn(frame, T_last_cam);
    }
    initialized_ = true;
    int reference = map_.observers(located.landmarks).front().keyframe;
    const bool proves_a_place = record.origin == FrameOrigin::Recovered;
    const bool inserts =
        believed && (decision_.wants(map_, located, frames_since_keyframe_) || proves_a_place);
    if (believed && (inserts || frames_since_keyframe_ % check_interval_frames == 0)) {
        uncertainty_.note(disagreementOfHalves(
            matchesOf(frame, located.landmarks, map_, options_.sensor), cameras_, located));
    }
    if (inserts) {
        applyPendingAdjustment();
        if (decision_.reference() != map_.keyframes().back().id) link_ = Link::None;
        reference =
            insertKeyframe(frame, located, map_.keyframe(reference).submap, tiesOf(located));
        record.keyframe = reference;
        located.landmarks = map_.keyframe(reference).landmarks;
    }
    record.inliers = located.inliers;
    record.covariance = packed(covarianceAgainstMap(located));
    record.reference_keyframe = reference;
    if (believed) {
        motion_.located(located.T_cam_world, uncertainty_.scale() * covarianceAgainstMap(located),
                        reference);
    } else {
        motion_.unlocated();
    }
    record.T_cam_reference = located.T_cam_world * map_.T_cam_world(reference).inverse();
    tracker_.setLast(std::move(frame), std::move(located), reference, true);
}

/** The map is not seen: the frame is tied to the last one, starts a submap, or is lost. */
void SlamPipeline::handleTrackingLoss(Frame frame, FrameRecord& record) {
    std::optional<SE3> T_last_cam;
    const SE3 guess = fallback_.guess(frame);
    if (initialized_ && options_.recovery.dead_reckoning) {
        times_.measure("dead-reckoning",
                       [&] { T_last_cam = fallback_.follow(frame, trajectory_.lastPose(map_)); });
    } else {
        fallback_.miss(frame);
    }
    const bool doubted = record.origin == FrameOrigin::Uncertain;
    record.origin = !T_last_cam ? FrameOrigin::Lost
                    : doubted   ? FrameOrigin::Uncertain
                                : FrameOrigin::DeadReckoned;
    if (T_last_cam && link_ == Link::Tracked) link_ = Link::DeadReckoned;
    SE3 T_cam_world = T_last_cam.value_or(SE3()).inverse() * trajectory_.lastPose(map_);
    // Inverses that are transposes double the rounding error of a chain with each link_.
    T_cam_world.R = orthonormalized(T_cam_world.R);
    record.reference_keyframe = trajectory_.lastReference();
    record.T_cam_reference = T_cam_world * map_.T_cam_world(record.reference_keyframe).inverse();
    record.covariance = packed(covarianceOf(fallback_.prior().spread()));
    const bool by_sensors = T_last_cam && T_last_cam->t == guess.t && T_last_cam->R == guess.R;
    if (by_sensors && motion_.predicted()) {
        T_cam_world = motion_.predicted()->T_cam_world;
        record.T_cam_reference =
            T_cam_world * map_.T_cam_world(record.reference_keyframe).inverse();
        record.covariance = packed(motion_.predicted()->covariance);
    }
    motion_.unlocated();
    if (fallback_.shouldStartSubmap(frame, T_last_cam || !initialized_)) {
        return startSubmap(std::move(frame), record);
    }
    if (!T_last_cam) return tracker_.forget();
    LocatedFrame located{T_cam_world, std::vector<int>(frame.keypoints.size(), no_landmark), 0};
    tracker_.setLast(std::move(frame), std::move(located), record.reference_keyframe, true);
}

/** A keyframe that shares nothing with those before: where dead reckoning says it is, or in a
 * submap of its own. */
void SlamPipeline::startSubmap(Frame frame, FrameRecord& record) {
    applyPendingAdjustment();
    const bool tied =
        record.origin == FrameOrigin::DeadReckoned || record.origin == FrameOrigin::Uncertain;
    link_ = tied ? Link::DeadReckoned : Link::None;
    const int new_submap = static_cast<int>(map_.keyframes().size());
    LocatedFrame located;
    located.landmarks.assign(frame.keypoints.size(), no_landmark);
    if (!map_.keyframes().empty()) located.T_cam_world = record.T_cam_world(map_);
    std::vector<KeyframeTie> ties;
    if (tied)
        ties.push_back({record.reference_keyframe, record.T_cam_reference,
                        covarianceOf(fallback_.prior().spread())});
    const int id = insertKeyframe(
        frame, located, tied ? map_.keyframe(record.reference_keyframe).submap : new_submap, ties);
    located.landmarks = map_.keyframe(id).landmarks;
    if (!tied) {
        record.origin = FrameOrigin::Tracked;
        motion_.forgetPose();
    }
    record.keyframe = record.reference_keyframe = id;
    record.T_cam_reference = SE3();
    record.covariance = packed(covarianceOf({}));
    record.inliers =
        static_cast<int>(std::count_if(located.landmarks.begin(), located.landmarks.end(),
                                       [](int l) { return l != no_landmark; }));
    initialized_ = true;
    fallback_.restart(frame, std::nullopt);
    tracker_.setLast(std::move(frame), std::move(located), id, tied);
}

std::vector<PoseEdge> SlamPipeline::closeLoops(int keyframe) {
    std::vector<PoseEdge> loops = findLoops(keyframe);
    if (loops.empty()) return loops;
    PoseGraph graph = edges_.graph(closer_.loops());
    times_.measure("optimize", [&] { optimizePoseGraph(graph, options_.pose_graph); });
    correct(graph.nodes);
    return loops;
}

std::vector<PoseEdge> SlamPipeline::findLoops(int keyframe) {
    std::vector<PoseEdge> loops;
    if (!options_.loops.enabled) return loops;
    times_.measure("find-loops", [&] { loops = closer_.findLoops(keyframe); });
    // What comes next asks where keyframes are, and adjusts everything anew.
    if (!loops.empty()) applyPendingAdjustments();
    for (const PoseEdge& loop : loops) {
        mergeSubmaps(loop);
        uncertainty_.closeLoop(loop.from, loop.to, loop.T_from_to);
    }
    return loops;
}

void SlamPipeline::correct(const std::vector<SE3>& T_world_keyframe) {
    applyPendingAdjustment();
    bool closed = false;
    times_.measure("correct", [&] { closed = closer_.correct(T_world_keyframe, mapper_); });
    if (!closed || !options_.mapper.loop_adjustment) return;
    global_adjuster_.start(options_.mapper.loop_iterations);
    frames_since_loop_ = 0;
}

void SlamPipeline::finish() {
    applyPendingAdjustments();
    if (!options_.mapper.final_adjustment) return;
    times_.measure("final-adjustment", [&] { global_adjuster_.adjustNow(final_iterations); });
}

void SlamPipeline::mergeSubmaps(const PoseEdge& loop) {
    const int from = map_.keyframe(loop.from).submap, to = map_.keyframe(loop.to).submap;
    if (from == to) return;
    applyPendingAdjustment();
    const SE3 T_world_to = map_.T_cam_world(loop.from).inverse() * loop.T_from_to;
    const SE3 motion = T_world_to * map_.T_cam_world(loop.to);
    if (to > from) {
        map_.mergeSubmap(to, from, motion);
    } else {
        map_.mergeSubmap(from, to, motion.inverse());
    }
}

/** A share of the landmarks ties less firmly than all of them. */
std::vector<KeyframeTie> SlamPipeline::tiesOf(const LocatedFrame& located) const {
    std::vector<KeyframeTie> ties;
    const Matrix6d covariance = uncertainty_.scale() * covarianceAgainstMap(located);
    for (const Covisibility& c : map_.observers(located.landmarks, fewest_that_tie)) {
        const double share = std::min(1.0, c.shared / std::max(1.0, 1.0 * located.inliers));
        ties.push_back({c.keyframe, located.T_cam_world * map_.T_cam_world(c.keyframe).inverse(),
                        covariance / share});
    }
    return ties;
}

int SlamPipeline::insertKeyframe(const Frame& frame, const LocatedFrame& located, int submap,
                                 const std::vector<KeyframeTie>& ties) {
    int id = 0;
    uncertainty_.add(ties);
    times_.measure("map", [&] {
        id = map_.addKeyframe(frame, located.T_cam_world, submap, link_);
        map_.addObservations(located.landmarks, id);
        mapper_.insert(id);
    });
    decision_.reset(map_.keyframe(id));
    frames_since_keyframe_ = 0;
    link_ = Link::Tracked;
    return id;
}

void SlamPipeline::applyPendingAdjustment() {
    if (!mapper_.pending()) return;
    double adjustment_ms = 0;
    times_.measure("apply-adjustment", [&] { adjustment_ms = mapper_.applyPendingAdjustment(); });
    times_.add("local-adjustment", adjustment_ms, adjustment_ms);
}

void SlamPipeline::applyPendingAdjustments() {
    applyPendingAdjustment();
    if (!global_adjuster_.pending()) return;
    double adjustment_ms = 0;
    times_.measure("apply-adjustment",
                   [&] { adjustment_ms = global_adjuster_.applyPendingAdjustment(); });
    times_.add("loop-adjustment", adjustment_ms, adjustment_ms);
}

std::vector<KeyframeView> SlamPipeline::keyframes() const {
    std::vector<KeyframeView> views;
    for (const Keyframe& keyframe : map_.keyframes()) {
        views.push_back({keyframe.id, keyframe.frame.stamp_s,
                         map_.T_cam_world(keyframe.id).inverse(), keyframe.culled,
                         keyframe.submap});
    }
    return views;
}

std::vector<LandmarkView> SlamPipeline::landmarks() const {
    std::vector<LandmarkView> views;
    for (const Landmark& landmark : map_.landmarks()) {
        if (!landmark.alive) continue;
        views.push_back({landmark.position, static_cast<int>(landmark.observations.size())});
    }
    return views;
}

MapSnapshot SlamPipeline::snapshot() const {
    return takeSnapshot(map_, rig_, options_.features.scale_factor, closer_.loops());
}

}  // namespace rgbd_graphslam
