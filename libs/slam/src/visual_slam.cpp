#include "rgbd_graphslam/slam/visual_slam.h"

#include <algorithm>
#include <cmath>

#include "keyframe_decision.h"
#include "keyframe_edges.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/features/frame_builder.h"
#include "rgbd_graphslam/slam/full_adjuster.h"
#include "rgbd_graphslam/slam/local_mapper.h"
#include "rgbd_graphslam/slam/loop_closer.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/stage_times.h"
#include "rgbd_graphslam/slam/tracker.h"
#include "rgbd_graphslam/slam/weak_tracker.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_first_landmarks = 50;
constexpr int final_iterations = 10;
/** Of the points that an anchor had at best; with fewer the next frame follows another. */
constexpr double anchor_share = 0.5;

constexpr std::size_t record_bytes = sizeof(double) + 1 + 3 * 4 + pose_bytes;

/** A frame as it is kept: tied to a keyframe, so that it moves with the map. */
struct FrameRecord {
    double stamp_s = 0;
    FrameOrigin origin = FrameOrigin::Lost;
    int inliers = 0;
    int reference_keyframe = 0;
    SE3 T_cam_reference;
    std::optional<int> keyframe;
};

void put(const FrameRecord& record, ByteWriter& out) {
    out.put(record.stamp_s);
    out.put(static_cast<std::uint8_t>(record.origin));
    out.put<std::int32_t>(record.inliers);
    out.putCount(record.reference_keyframe);
    encodePose(record.T_cam_reference, out);
    out.put<std::int32_t>(record.keyframe.value_or(-1));
}

FrameRecord getRecord(ByteReader& in, std::size_t keyframes) {
    FrameRecord record;
    record.stamp_s = getFinite(in);
    const auto origin = in.get<std::uint8_t>();
    if (origin > static_cast<std::uint8_t>(FrameOrigin::Lost))
        throw DamagedBytes("a frame of no kind");
    record.origin = static_cast<FrameOrigin>(origin);
    record.inliers = in.get<std::int32_t>();
    record.reference_keyframe = getIndex(in, std::max<std::size_t>(1, keyframes), "keyframe");
    record.T_cam_reference = decodePose(in);
    const auto keyframe = in.get<std::int32_t>();
    if (keyframe >= 0) record.keyframe = keyframe;
    return record;
}

int keypointsWithDepth(const Frame& frame) {
    return static_cast<int>(std::count_if(frame.keypoints.begin(), frame.keypoints.end(),
                                          [](const Keypoint& k) { return k.depth_m > 0; }));
}

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
        case FrameOrigin::Weak:
            return "weak";
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
          full_adjuster(options, camera, map),
          closer(options, camera, map),
          edges(options.sensor, camera, map),
          decision(options.keyframes) {}

    void restore(MapSnapshot snapshot, MapUse use);
    void save(ByteWriter& out) const;
    void load(ByteReader& in);
    TrackedFrame track(Frame frame);
    TrackedFrame view(const FrameRecord& record) const;
    void handOver();
    void handOverAll();
    void join(const PoseEdge& loop);

    const SlamOptions options;
    const Camera camera;
    const FrameBuilder builder;
    SlamMap map;
    Tracker tracker;
    LocalMapper mapper;
    FullAdjuster full_adjuster;
    LoopCloser closer;
    const KeyframeEdges edges;
    WeakTracker weak;
    /** While the map is not seen: follows one frame for as long as it can, so that errors do not
     * add up from frame to frame. */
    std::optional<Tracker> anchor;
    int anchor_inliers = 0;
    KeyframeDecision decision;
    std::vector<FrameRecord> records;
    int frames_since_keyframe = 0;
    int frames_since_loop = 0;
    /** The map may not change. */
    bool frozen = false;
    /** Of the next keyframe to the last one. */
    Link link = Link::Tracked;
    /** Whether any frame of this run has been located. */
    bool placed = false;
    /** Frames since the map was seen that could have gone on with it. */
    int astray = 0;
    mutable StageTimes times;

  private:
    void start(Frame frame, FrameRecord& record);
    std::optional<LocatedFrame> locate(const Frame& frame, FrameRecord& record);
    void keep(Frame frame, LocatedFrame located, FrameRecord& record);
    void stray(Frame frame, FrameRecord& record);
    std::optional<SE3> weakMotion(const Frame& frame);
    bool canBeginAnew(const Frame& frame, FrameOrigin origin);
    void beginAnew(Frame frame, FrameRecord& record);
    SE3 lastPose() const;
    int insertKeyframe(const Frame& frame, const LocatedFrame& located, int part);
};

void VisualSlam::Implementation::restore(MapSnapshot snapshot, MapUse use) {
    checkFits(snapshot, options.features, camera, use);
    map.restore(std::move(snapshot.keyframes), std::move(snapshot.landmarks));
    times.measure("place-index", [&] { closer.restore(std::move(snapshot.loops)); });
    decision.reset(map.keyframes().back());
    frozen = use == MapUse::Localise;
    link = Link::None;
}

void VisualSlam::Implementation::save(ByteWriter& out) const {
    map.save(out);
    tracker.save(out);
    mapper.save(out);
    full_adjuster.save(out);
    closer.save(out);
    weak.save(out);
    putFlag(anchor.has_value(), out);
    if (anchor) anchor->save(out);
    decision.save(out);
    out.putCount(records.size());
    for (const FrameRecord& record : records) put(record, out);
    for (const int number : {anchor_inliers, frames_since_keyframe, frames_since_loop, astray}) {
        out.put<std::int32_t>(number);
    }
    for (const bool flag : {frozen, placed}) putFlag(flag, out);
    put(link, out);
}

void VisualSlam::Implementation::load(ByteReader& in) {
    map.load(in, camera);
    tracker.load(in);
    mapper.load(in);
    full_adjuster.load(in);
    closer.load(in);
    weak.load(in);
    if (getFlag(in)) anchor.emplace(options, camera, map).load(in);
    decision.load(in, map.keyframes().size());
    records.resize(in.getCount(record_bytes));
    for (FrameRecord& record : records) record = getRecord(in, map.keyframes().size());
    for (int* number : {&anchor_inliers, &frames_since_keyframe, &frames_since_loop, &astray}) {
        *number = in.get<std::int32_t>();
    }
    for (bool* flag : {&frozen, &placed}) *flag = getFlag(in);
    link = getLink(in);
}

TrackedFrame VisualSlam::Implementation::track(Frame frame) {
    if (!records.empty() && frame.stamp_s <= records.back().stamp_s) {
        throw Error("frame at " + std::to_string(frame.stamp_s) +
                        " s is not later than the last, " + std::to_string(records.back().stamp_s) +
                        " s",
                    "leave it out or sort the frames");
    }
    ++frames_since_keyframe;
    ++frames_since_loop;
    if (mapper.pending() && frames_since_keyframe >= options.mapper.hand_over_frames) handOver();
    if (frames_since_loop == options.mapper.loop_hand_over_frames) handOverAll();
    FrameRecord record;
    record.stamp_s = frame.stamp_s;
    if (map.keyframes().empty()) {
        start(std::move(frame), record);
    } else {
        auto located = locate(frame, record);
        if (located) {
            keep(std::move(frame), std::move(*located), record);
        } else {
            stray(std::move(frame), record);
        }
    }
    records.push_back(record);
    return view(record);
}

/** The first frame with enough depth becomes the origin of the world. */
void VisualSlam::Implementation::start(Frame frame, FrameRecord& record) {
    if (keypointsWithDepth(frame) < fewest_first_landmarks) return;
    beginAnew(std::move(frame), record);
}

std::optional<LocatedFrame> VisualSlam::Implementation::locate(const Frame& frame,
                                                               FrameRecord& record) {
    std::optional<LocatedFrame> located;
    times.measure("track", [&] { located = tracker.track(frame); });
    record.origin = FrameOrigin::Tracked;
    if (located) return located;
    handOver();
    times.measure("relocalise", [&] { located = closer.relocalise(frame, tracker); });
    record.origin = FrameOrigin::Recovered;
    if (!located) return located;
    tracker.forget();
    link = Link::None;
    return located;
}

/** T_cam_world of the last frame, or where it was known last. */
SE3 VisualSlam::Implementation::lastPose() const {
    if (records.empty()) return map.T_cam_world(0);
    return records.back().T_cam_reference * map.T_cam_world(records.back().reference_keyframe);
}

void VisualSlam::Implementation::keep(Frame frame, LocatedFrame located, FrameRecord& record) {
    weak.restart(frame, placed ? lastPose() * located.T_cam_world.inverse() : SE3());
    placed = true;
    astray = 0;
    anchor.reset();
    int reference = map.observers(located.landmarks).front().keyframe;
    const bool proves_a_place = record.origin == FrameOrigin::Recovered;
    if (!frozen && (decision.wants(map, located, frames_since_keyframe) || proves_a_place)) {
        handOver();
        reference = insertKeyframe(frame, located, map.keyframe(reference).part);
        record.keyframe = reference;
        located.landmarks = map.keyframe(reference).landmarks;
    }
    record.inliers = located.inliers;
    record.reference_keyframe = reference;
    record.T_cam_reference = located.T_cam_world * map.T_cam_world(reference).inverse();
    tracker.setLast(std::move(frame), std::move(located), reference, true);
}

/** The map is not seen: the frame is tied to the last one, begins anew, or is lost. */
void VisualSlam::Implementation::stray(Frame frame, FrameRecord& record) {
    std::optional<SE3> T_last_cam;
    if (placed && options.recovery.weak_motion) {
        times.measure("weak-motion", [&] { T_last_cam = weakMotion(frame); });
    }
    record.origin = T_last_cam ? FrameOrigin::Weak : FrameOrigin::Lost;
    if (T_last_cam && link == Link::Tracked) link = Link::Weak;
    SE3 T_cam_world = T_last_cam.value_or(SE3()).inverse() * lastPose();
    // Inverses that are transposes double the rounding error of a chain with each link.
    T_cam_world.R = orthonormalised(T_cam_world.R);
    record.reference_keyframe = records.empty() ? 0 : records.back().reference_keyframe;
    record.T_cam_reference = T_cam_world * map.T_cam_world(record.reference_keyframe).inverse();
    if (!frozen && canBeginAnew(frame, record.origin)) return beginAnew(std::move(frame), record);
    if (!T_last_cam) return tracker.forget();
    LocatedFrame located{T_cam_world, std::vector<int>(frame.keypoints.size(), no_landmark), 0};
    tracker.setLast(std::move(frame), std::move(located), record.reference_keyframe, true);
}

std::optional<SE3> VisualSlam::Implementation::weakMotion(const Frame& frame) {
    if (!anchor) {
        anchor.emplace(tracker);
        anchor_inliers = 0;
    }
    const auto followed = anchor->followLast(frame, weak.guess(frame).inverse() * lastPose());
    if (!followed) {
        anchor.reset();
        return weak.follow(frame);
    }
    anchor_inliers = std::max(anchor_inliers, followed->inliers);
    if (followed->inliers < anchor_share * anchor_inliers) anchor.reset();
    const SE3 T_last_cam = lastPose() * followed->T_cam_world.inverse();
    weak.restart(frame, T_last_cam);
    return T_last_cam;
}

bool VisualSlam::Implementation::canBeginAnew(const Frame& frame, FrameOrigin origin) {
    if (keypointsWithDepth(frame) < options.recovery.fewest_keypoints) return false;
    ++astray;
    return astray >= (origin == FrameOrigin::Weak ? options.recovery.weak_keyframe_after
                                                  : options.recovery.new_part_after);
}

/** A keyframe that shares nothing with those before: where weak motion says it is, or in a part of
 *  its own. */
void VisualSlam::Implementation::beginAnew(Frame frame, FrameRecord& record) {
    handOver();
    const bool tied = record.origin == FrameOrigin::Weak;
    link = tied ? Link::Weak : Link::None;
    const int new_part = static_cast<int>(map.keyframes().size());
    LocatedFrame located;
    located.landmarks.assign(frame.keypoints.size(), no_landmark);
    if (!map.keyframes().empty()) {
        located.T_cam_world = record.T_cam_reference * map.T_cam_world(record.reference_keyframe);
    }
    const int id = insertKeyframe(frame, located,
                                  tied ? map.keyframe(record.reference_keyframe).part : new_part);
    located.landmarks = map.keyframe(id).landmarks;
    if (!tied) record.origin = FrameOrigin::Tracked;
    record.keyframe = record.reference_keyframe = id;
    record.T_cam_reference = SE3();
    record.inliers =
        static_cast<int>(std::count_if(located.landmarks.begin(), located.landmarks.end(),
                                       [](int l) { return l != no_landmark; }));
    placed = true;
    astray = 0;
    anchor.reset();
    weak.restart(frame, SE3());
    tracker.setLast(std::move(frame), std::move(located), id, tied);
}

/** Brings two parts of the map together where a loop says. */
void VisualSlam::Implementation::join(const PoseEdge& loop) {
    const int from = map.keyframe(loop.from).part, to = map.keyframe(loop.to).part;
    if (from == to) return;
    handOver();
    const SE3 T_world_to = map.T_cam_world(loop.from).inverse() * loop.T_from_to;
    const SE3 motion = T_world_to * map.T_cam_world(loop.to);
    if (to > from) {
        map.joinPart(to, from, motion);
    } else {
        map.joinPart(from, to, motion.inverse());
    }
}

int VisualSlam::Implementation::insertKeyframe(const Frame& frame, const LocatedFrame& located,
                                               int part) {
    int id = 0;
    times.measure("map", [&] {
        id = map.addKeyframe(frame, located.T_cam_world, part, link);
        for (std::size_t i = 0; i < located.landmarks.size(); ++i) {
            if (located.landmarks[i] == no_landmark) continue;
            map.addObservation(located.landmarks[i], id, static_cast<int>(i));
        }
        mapper.insert(id);
    });
    decision.reset(map.keyframe(id));
    frames_since_keyframe = 0;
    link = Link::Tracked;
    return id;
}

void VisualSlam::Implementation::handOver() {
    if (!mapper.pending()) return;
    double adjustment_ms = 0;
    times.measure("hand-over", [&] { adjustment_ms = mapper.handOver(); });
    times.add("local-adjustment", adjustment_ms, adjustment_ms);
}

/** The adjustment of everything as well, if one is under way. */
void VisualSlam::Implementation::handOverAll() {
    handOver();
    if (!full_adjuster.pending()) return;
    double adjustment_ms = 0;
    times.measure("hand-over", [&] { adjustment_ms = full_adjuster.handOver(); });
    times.add("loop-adjustment", adjustment_ms, adjustment_ms);
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
    frame.part = map.keyframe(record.reference_keyframe).part;
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
    return impl_->edges.odometry(keyframe);
}

std::vector<PoseEdge> VisualSlam::findLoops(int keyframe) {
    std::vector<PoseEdge> loops;
    if (!impl_->options.loops.enabled) return loops;
    impl_->times.measure("find-loops", [&] { loops = impl_->closer.findLoops(keyframe); });
    // What comes next asks where keyframes are, and adjusts everything anew.
    if (!loops.empty()) impl_->handOverAll();
    for (const PoseEdge& loop : loops) impl_->join(loop);
    return loops;
}

PoseGraph VisualSlam::poseGraph() const {
    return impl_->edges.graph(impl_->closer.loops());
}

void VisualSlam::correct(const std::vector<SE3>& T_world_keyframe) {
    impl_->handOver();
    impl_->times.measure("correct",
                         [&] { impl_->closer.correct(T_world_keyframe, impl_->mapper); });
    if (!impl_->options.mapper.loop_adjustment) return;
    impl_->full_adjuster.start(impl_->options.mapper.loop_iterations);
    impl_->frames_since_loop = 0;
}

void VisualSlam::finish() {
    impl_->handOverAll();
    if (impl_->frozen || !impl_->options.mapper.final_adjustment) return;
    impl_->times.measure("final-adjustment",
                         [&] { impl_->full_adjuster.adjustNow(final_iterations); });
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
                         impl_->map.T_cam_world(keyframe.id).inverse(), keyframe.culled,
                         keyframe.part});
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
