#include "rgbd_graphslam/slam/loop_closer.h"

#include <algorithm>
#include <utility>

#include "keyframe_alignment.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_votes = 15;
constexpr int fused_neighbors = 10;
}  // namespace

LoopCloser::LoopCloser(const SlamOptions& options, const RigCameras& cameras, SlamMap& map)
    : options_(options),
      cameras_(cameras),
      map_(map),
      plausibility_(options.loops, map, loops_),
      index_(options.loops.bits_hamming),
      verifier_(options, cameras, map) {}

std::vector<Descriptor> LoopCloser::placeDescriptors(int keyframe) const {
    const Keyframe& k = map_.keyframe(keyframe);
    std::vector<Descriptor> descriptors;
    for (std::size_t i = 0; i < k.landmarks.size(); ++i) {
        if (k.landmarks[i] != no_landmark) {
            descriptors.push_back(k.frame.descriptors[i]);
        }
    }
    return descriptors;
}

/** The first of the keyframes just before one, which tracking ties to it. */
int LoopCloser::firstTooNear(int keyframe) const {
    const int farthest = std::max(0, keyframe - options_.loops.min_keyframe_gap + 1);
    int first = keyframe;
    while (first > farthest && map_.keyframe(first).link == Link::Tracked) --first;
    return first;
}

/** Best-voted earlier keyframes within reach that the map does not connect with this one yet. */
std::vector<int> LoopCloser::candidatesFor(int keyframe) const {
    const auto neighbors = map_.covisible(keyframe, 1);
    const int newest = firstTooNear(keyframe);
    std::vector<int> candidates;
    for (const PlaceVote& vote : index_.query(placeDescriptors(keyframe))) {
        if (vote.votes < fewest_votes) break;
        if (static_cast<int>(candidates.size()) >= options_.loops.candidates) break;
        if (vote.keyframe >= newest) continue;
        if (map_.keyframe(vote.keyframe).culled || !plausibility_.mightSee(keyframe, vote.keyframe))
            continue;
        const bool connected =
            std::any_of(neighbors.begin(), neighbors.end(),
                        [&](const Covisibility& c) { return c.keyframe == vote.keyframe; });
        if (!connected) candidates.push_back(vote.keyframe);
    }
    return candidates;
}

void LoopCloser::restore(std::vector<PoseEdge> loops) {
    loops_ = std::move(loops);
    std::vector<std::vector<Descriptor>> descriptors;
    for (const Keyframe& k : map_.keyframes()) descriptors.push_back(placeDescriptors(k.id));
    index_.insertAll(descriptors);
}

void LoopCloser::forgetCulled() {
    const std::vector<int>& culled = map_.culled();
    for (; forgotten_ < culled.size(); ++forgotten_) index_.erase(culled[forgotten_]);
}

void LoopCloser::save(ByteWriter& out) const {
    index_.save(out);
    plausibility_.save(out);
    out.putCount(forgotten_);
    out.putCount(loops_.size());
    for (const PoseEdge& loop : loops_) put(loop, out);
}

void LoopCloser::load(ByteReader& in) {
    index_.load(in, map_.keyframes().size());
    plausibility_.load(in);
    forgotten_ = getIndex(in, map_.culled().size() + 1, "culled keyframe");
    const std::size_t loops = in.getCount(edge_bytes);
    for (std::size_t i = 0; i < loops; ++i) {
        loops_.push_back(getEdge(in, map_.keyframes().size(), EdgeKind::Loop));
    }
}

std::vector<PoseEdge> LoopCloser::findLoops(int keyframe) {
    plausibility_.travelTo(keyframe);
    forgetCulled();
    std::vector<VerifiedLoop> verified;
    for (const int candidate : candidatesFor(keyframe)) {
        if (auto loop = verify(keyframe, candidate)) verified.push_back(std::move(*loop));
    }
    index_.insert(keyframe, placeDescriptors(keyframe));
    auto loop = plausibility_.likeliest(std::move(verified));
    if (!loop) return {};
    const PoseEdge edge = loop->edge;
    loops_.push_back(edge);
    unfused_.push_back(std::move(*loop));
    return {edge};
}

std::optional<VerifiedLoop> LoopCloser::verify(int keyframe, int candidate) {
    Frame frame = map_.keyframe(keyframe).frame;  // its keypoints move to the candidate's
    const auto aligned =
        alignWithKeyframe(frame, map_.keyframe(candidate), map_, cameras_, options_);
    if (!aligned) return std::nullopt;
    const auto located = verifier_.trackLocalMap(frame, aligned->T_cam_world, aligned->landmarks,
                                                 KernelShape::GemanMcClure);
    if (!located || located->inliers < options_.loops.min_inliers) return std::nullopt;
    const auto matches = matchesOf(frame, located->landmarks, map_, options_.sensor);
    VerifiedLoop loop;
    loop.edge.from = candidate;
    loop.edge.to = keyframe;
    loop.edge.T_from_to = map_.T_cam_world(candidate) * located->T_cam_world.inverse();
    loop.edge.information =
        solvePose(cameras_.mounted(), matches, located->T_cam_world).information;
    loop.edge.kind = EdgeKind::Loop;
    loop.edge.inliers = located->inliers;
    loop.asked = plausibility_.asked(loop.edge);
    loop.seen_again = located->landmarks;
    for (const Covisibility& c : map_.observers(located->landmarks)) {
        const auto& seen = map_.keyframe(c.keyframe).landmarks;
        loop.landmarks.insert(loop.landmarks.end(), seen.begin(), seen.end());
    }
    std::sort(loop.landmarks.begin(), loop.landmarks.end());
    loop.landmarks.erase(std::unique(loop.landmarks.begin(), loop.landmarks.end()),
                         loop.landmarks.end());
    return loop;
}

std::vector<int> LoopCloser::placesLike(const Frame& frame, int most) const {
    std::vector<int> keyframes;
    for (const PlaceVote& vote : index_.query(frame.descriptors)) {
        if (vote.votes < fewest_votes || static_cast<int>(keyframes.size()) >= most) break;
        if (!map_.keyframe(vote.keyframe).culled) keyframes.push_back(vote.keyframe);
    }
    return keyframes;
}

bool LoopCloser::correct(const std::vector<SE3>& T_world_keyframe, LocalMapper& mapper) {
    std::vector<SE3> moved;
    for (const Keyframe& keyframe : map_.keyframes()) {
        moved.push_back(T_world_keyframe[keyframe.id] * map_.T_cam_world(keyframe.id));
    }
    for (std::size_t id = 0; id < map_.landmarks().size(); ++id) {
        const Landmark& landmark = map_.landmark(static_cast<int>(id));
        if (!landmark.alive) continue;
        map_.moveLandmark(static_cast<int>(id), moved[landmark.observations.back().keyframe]);
    }
    for (const Keyframe& keyframe : map_.keyframes()) {
        if (!keyframe.culled) map_.setPose(keyframe.id, T_world_keyframe[keyframe.id].inverse());
    }
    bool closed = false;
    for (const VerifiedLoop& loop : std::exchange(unfused_, {})) {
        if (plausibility_.followed(loop)) {
            fuse(loop, mapper);
            closed = true;
        } else {
            forget(loop.edge);
        }
    }
    return closed;
}

void LoopCloser::forget(const PoseEdge& edge) {
    const auto same = [&](const PoseEdge& e) { return e.from == edge.from && e.to == edge.to; };
    loops_.erase(std::remove_if(loops_.begin(), loops_.end(), same), loops_.end());
}

/** What verification matched is one landmark, whatever distance the drift put between the two. */
void LoopCloser::fuse(const VerifiedLoop& loop, LocalMapper& mapper) {
    const int keyframe = loop.edge.to;
    for (std::size_t i = 0; i < loop.seen_again.size(); ++i) {
        const int old = loop.seen_again[i];
        if (old == no_landmark || !map_.landmark(old).alive) continue;
        if (map_.keypointOf(old, keyframe) >= 0) continue;
        const int young = map_.keyframe(keyframe).landmarks[i];
        if (young == no_landmark) {
            map_.addObservation(old, keyframe, static_cast<int>(i));
        } else {
            map_.fuse(young, old);
        }
    }
    auto neighbors = map_.covisible(keyframe);
    if (neighbors.size() > fused_neighbors) neighbors.resize(fused_neighbors);
    mapper.joinInto(keyframe, loop.landmarks);
    for (const Covisibility& c : neighbors) mapper.joinInto(c.keyframe, loop.landmarks);
}

}  // namespace rgbd_graphslam
