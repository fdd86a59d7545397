#include "visual_slam_implementation.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "map_fit.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_first_landmarks = 50;

}  // namespace

void VisualSlam::Implementation::restore(MapSnapshot snapshot, MapUse use) {
    requireFits(snapshot, options.features, camera, use);
    seeWith(camera, snapshot);
    map.restore(std::move(snapshot.keyframes), std::move(snapshot.landmarks));
    times.measure("place-index", [&] { closer.restore(std::move(snapshot.loops)); });
    decision.reset(map.keyframes().back());
    if (use == MapUse::Localize) map.freeze();
    uncertainty.restore(map.keyframes().size());
    link = Link::None;
}

void VisualSlam::Implementation::save(ByteWriter& out) const {
    map.save(out);
    tracker.save(out);
    mapper.save(out);
    global_bundle_adjuster.save(out);
    closer.save(out);
    fallback.save(out);
    relocalizer.save(out);
    decision.save(out);
    records.save(out);
    uncertainty.save(out);
    for (const int number : {frames_since_keyframe, frames_since_loop}) {
        out.put<std::int32_t>(number);
    }
    putFlag(initialized, out);
    put(link, out);
}

void VisualSlam::Implementation::load(ByteReader& in) {
    map.load(in, camera);
    tracker.load(in);
    mapper.load(in);
    global_bundle_adjuster.load(in);
    closer.load(in);
    fallback.load(in, camera, builder.viewCamera(), map.levels());
    relocalizer.load(in);
    decision.load(in, map.keyframes().size());
    records.load(in, map.keyframes().size());
    uncertainty.load(in, map.keyframes().size());
    for (int* number : {&frames_since_keyframe, &frames_since_loop}) {
        *number = getTally(in);
    }
    initialized = getFlag(in);
    link = getLink(in);
}

TrackedFrame VisualSlam::Implementation::track(Frame frame) {
    records.requireLater(frame.stamp_s);
    ++frames_since_keyframe;
    ++frames_since_loop;
    if (mapper.pending() && frames_since_keyframe >= options.mapper.adjustment_delay_frames)
        applyPendingAdjustment();
    if (frames_since_loop == options.mapper.loop_adjustment_delay_frames) applyPendingAdjustments();
    FrameRecord record;
    record.stamp_s = frame.stamp_s;
    if (map.keyframes().empty()) {
        start(std::move(frame), record);
    } else {
        auto located = locate(frame, record);
        if (located) {
            acceptTracked(std::move(frame), std::move(*located), record);
        } else {
            handleTrackingLoss(std::move(frame), record);
        }
    }
    records.add(record);
    return record.view(map, uncertainty);
}

/** The first frame with enough depth becomes the origin of the world. */
void VisualSlam::Implementation::start(Frame frame, FrameRecord& record) {
    if (keypointsWithDepth(frame) < fewest_first_landmarks) return;
    startSubmap(std::move(frame), record);
}

/** Nothing before any frame of this run has been located. */
std::optional<Prediction> VisualSlam::Implementation::prediction(const Frame& frame) const {
    if (!initialized) return std::nullopt;
    const SE3 T_cam_world = fallback.guess(frame).inverse() * records.lastPose(map);
    return Prediction{T_cam_world, map.keyframe(records.lastReference()).submap,
                      fallback.priorAt(frame)};
}

/** \param record its origin tells how far the pose is believed, or that it is doubted altogether */
std::optional<LocatedFrame> VisualSlam::Implementation::trackBelievably(Frame& frame,
                                                                        FrameRecord& record) {
    record.origin = FrameOrigin::Lost;
    const std::vector<Keypoint> keypoints = frame.keypoints;
    auto located = tracker.track(frame);
    if (!located) return located;
    record.origin = FrameOrigin::Tracked;
    if (options.tracker.detect_standstill) {
        const int nearest = map.observers(located->landmarks).front().keyframe;
        const Keyframe& keyframe = map.keyframe(nearest);
        if (standsAt(keyframe, frame, located->landmarks, map, camera)) {
            located->T_cam_world = keyframe.T_cam_world;
        }
    }
    if (!initialized) return located;
    const SE3 T_last_cam = records.lastPose(map) * located->T_cam_world.inverse();
    const Verdict verdict =
        judge(*located, {fallback.guess(frame).inverse() * T_last_cam, fallback.priorAt(frame)},
              {fallback.inertia(frame).inverse() * T_last_cam, fallback.priorByInertia(frame)});
    if (verdict == Verdict::Believed) return located;
    record.origin = FrameOrigin::Uncertain;
    if (verdict == Verdict::Uncertain) return located;
    frame.keypoints = keypoints;
    return std::nullopt;
}

std::optional<LocatedFrame> VisualSlam::Implementation::locate(Frame& frame, FrameRecord& record) {
    std::optional<LocatedFrame> located;
    times.measure("track", [&] { located = trackBelievably(frame, record); });
    if (located) return located;
    applyPendingAdjustment();
    times.measure("relocalize", [&] { located = relocalizer.find(frame, prediction(frame)); });
    if (!located) return located;
    record.origin = FrameOrigin::Recovered;
    tracker.forget();
    link = Link::None;
    return located;
}

void VisualSlam::Implementation::acceptTracked(Frame frame, LocatedFrame located,
                                               FrameRecord& record) {
    relocalizer.forget();
    const SE3 T_last_cam =
        initialized ? records.lastPose(map) * located.T_cam_world.inverse() : SE3();
    const bool believed = record.origin != FrameOrigin::Uncertain;
    if (believed) {
        const bool goes_on = initialized && record.origin == FrameOrigin::Tracked;
        fallback.restart(frame, goes_on ? std::optional<SE3>(T_last_cam) : std::nullopt);
    } else {
        fallback.goOn(frame, T_last_cam);
    }
    initialized = true;
    int reference = map.observers(located.landmarks).front().keyframe;
    const bool proves_a_place = record.origin == FrameOrigin::Recovered;
    if (believed && (decision.wants(map, located, frames_since_keyframe) || proves_a_place)) {
        applyPendingAdjustment();
        if (decision.reference() != map.keyframes().back().id) link = Link::None;
        reference = insertKeyframe(
            frame, located, map.keyframe(reference).submap, reference,
            {KeyframeLink::By::Landmarks, weakestDirection(covarianceAgainstMap(located))});
        record.keyframe = reference;
        located.landmarks = map.keyframe(reference).landmarks;
    }
    record.inliers = located.inliers;
    record.covariance = packed(covarianceAgainstMap(located));
    record.reference_keyframe = reference;
    record.T_cam_reference = located.T_cam_world * map.T_cam_world(reference).inverse();
    tracker.setLast(std::move(frame), std::move(located), reference, true);
}

/** The map is not seen: the frame is tied to the last one, begins anew, or is lost. */
void VisualSlam::Implementation::handleTrackingLoss(Frame frame, FrameRecord& record) {
    std::optional<SE3> T_last_cam;
    if (initialized && options.recovery.dead_reckoning) {
        times.measure("dead-reckoning",
                      [&] { T_last_cam = fallback.follow(frame, records.lastPose(map)); });
    } else {
        fallback.miss(frame);
    }
    const bool doubted = record.origin == FrameOrigin::Uncertain;
    record.origin = !T_last_cam ? FrameOrigin::Lost
                    : doubted   ? FrameOrigin::Uncertain
                                : FrameOrigin::DeadReckoned;
    if (T_last_cam && link == Link::Tracked) link = Link::DeadReckoned;
    SE3 T_cam_world = T_last_cam.value_or(SE3()).inverse() * records.lastPose(map);
    // Inverses that are transposes double the rounding error of a chain with each link.
    T_cam_world.R = orthonormalized(T_cam_world.R);
    record.reference_keyframe = records.lastReference();
    record.T_cam_reference = T_cam_world * map.T_cam_world(record.reference_keyframe).inverse();
    record.covariance = packed(covarianceOf(fallback.prior().spread()));
    if (fallback.shouldStartSubmap(frame, T_last_cam || !initialized)) {
        return startSubmap(std::move(frame), record);
    }
    if (!T_last_cam) return tracker.forget();
    LocatedFrame located{T_cam_world, std::vector<int>(frame.keypoints.size(), no_landmark), 0};
    tracker.setLast(std::move(frame), std::move(located), record.reference_keyframe, true);
}

/** A keyframe that shares nothing with those before: where weak motion says it is, or in a part of
 *  its own. */
void VisualSlam::Implementation::startSubmap(Frame frame, FrameRecord& record) {
    applyPendingAdjustment();
    const bool tied =
        record.origin == FrameOrigin::DeadReckoned || record.origin == FrameOrigin::Uncertain;
    link = tied ? Link::DeadReckoned : Link::None;
    const int new_submap = static_cast<int>(map.keyframes().size());
    LocatedFrame located;
    located.landmarks.assign(frame.keypoints.size(), no_landmark);
    if (!map.keyframes().empty()) located.T_cam_world = record.T_cam_world(map);
    const KeyframeLink tie{KeyframeLink::By::DeadReckoning,
                           tied ? fallback.prior().spread() : PoseSpread()};
    const int id = insertKeyframe(
        frame, located, tied ? map.keyframe(record.reference_keyframe).submap : new_submap,
        tied ? record.reference_keyframe : no_reference, tie);
    located.landmarks = map.keyframe(id).landmarks;
    if (!tied) record.origin = FrameOrigin::Tracked;
    record.keyframe = record.reference_keyframe = id;
    record.T_cam_reference = SE3();
    record.covariance = packed(covarianceOf({}));
    record.inliers =
        static_cast<int>(std::count_if(located.landmarks.begin(), located.landmarks.end(),
                                       [](int l) { return l != no_landmark; }));
    initialized = true;
    fallback.restart(frame, std::nullopt);
    tracker.setLast(std::move(frame), std::move(located), id, tied);
}

void VisualSlam::Implementation::join(const PoseEdge& loop) {
    const int from = map.keyframe(loop.from).submap, to = map.keyframe(loop.to).submap;
    if (from == to) return;
    applyPendingAdjustment();
    const SE3 T_world_to = map.T_cam_world(loop.from).inverse() * loop.T_from_to;
    const SE3 motion = T_world_to * map.T_cam_world(loop.to);
    if (to > from) {
        map.mergeSubmap(to, from, motion);
    } else {
        map.mergeSubmap(from, to, motion.inverse());
    }
}

int VisualSlam::Implementation::insertKeyframe(const Frame& frame, const LocatedFrame& located,
                                               int submap, int reference, const KeyframeLink& tie) {
    int id = 0;
    const SE3 T_cam_reference = reference == no_reference
                                    ? SE3()
                                    : located.T_cam_world * map.T_cam_world(reference).inverse();
    uncertainty.add(reference, T_cam_reference, tie);
    times.measure("map", [&] {
        id = map.addKeyframe(frame, located.T_cam_world, submap, link);
        map.addObservations(located.landmarks, id);
        mapper.insert(id);
    });
    decision.reset(map.keyframe(id));
    frames_since_keyframe = 0;
    link = Link::Tracked;
    return id;
}

void VisualSlam::Implementation::applyPendingAdjustment() {
    if (!mapper.pending()) return;
    double adjustment_ms = 0;
    times.measure("apply-adjustment", [&] { adjustment_ms = mapper.applyPendingAdjustment(); });
    times.add("local-adjustment", adjustment_ms, adjustment_ms);
}

void VisualSlam::Implementation::applyPendingAdjustments() {
    applyPendingAdjustment();
    if (!global_bundle_adjuster.pending()) return;
    double adjustment_ms = 0;
    times.measure("apply-adjustment",
                  [&] { adjustment_ms = global_bundle_adjuster.applyPendingAdjustment(); });
    times.add("loop-adjustment", adjustment_ms, adjustment_ms);
}

}  // namespace rgbd_graphslam
