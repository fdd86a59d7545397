#include "rgbd_graphslam/slam/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/ransac_alignment.h"

namespace rgbd_graphslam {
namespace {

constexpr float place_match_ratio = 0.85f;
constexpr int fewest_votes = 15;
constexpr int fewest_aligned = 15;
constexpr int relocalisation_candidates = 5;
constexpr int strong_covisibility = 100;
constexpr int fused_neighbours = 10;
/** What an edge is worth when two keyframes share too little to tell: 5 cm, 3 degrees. */
const Vector6d weak_sigma = (Vector6d() << 0.05, 0.05, 0.05, 0.05, 0.05, 0.05).finished();
constexpr int fewest_for_information = 10;
/** The same where nothing was measured between them: 10 m, 3 rad. */
const Vector6d unknown_sigma = (Vector6d() << 10, 10, 10, 3, 3, 3).finished();
/** What ties a keyframe that does not follow the one before. */
constexpr int fewest_that_tie = 15;

/** Disagreement of a loop with the map that needs no long path to explain. */
constexpr double least_drift_m = 0.3, least_drift_rad = 0.3;
constexpr double weak_link_m = 25;
/** Farther apart, two views have hardly a descriptor in common. */
constexpr double widest_view_m = 4, widest_view_rad = 1.2;
/** A loop with fewer inliers than this share of the best one's is no contender. */
constexpr double contender_share = 0.5;
/** A loop is unheeded if the optimised graph leaves more than this of what it asked. */
constexpr double unheeded_m = 0.05, unheeded_share = 0.25;

Matrix6d informationFrom(const Vector6d& sigma) {
    return sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
}

/** Some of a frame's keypoints. */
struct Selection {
    std::vector<int> keypoints;
    std::vector<Descriptor> descriptors;
};

template <class Wanted>
Selection select(const Frame& frame, Wanted&& wanted) {
    Selection selection;
    for (std::size_t i = 0; i < frame.keypoints.size(); ++i) {
        if (!wanted(i)) continue;
        selection.keypoints.push_back(static_cast<int>(i));
        selection.descriptors.push_back(frame.descriptors[i]);
    }
    return selection;
}

}  // namespace

LoopCloser::LoopCloser(const SlamOptions& options, const Camera& camera, SlamMap& map)
    : options_(options),
      camera_(camera),
      map_(map),
      index_(options.loops.bits_hamming),
      verifier_(options, camera, map) {}

std::vector<Descriptor> LoopCloser::placeDescriptors(int id) const {
    const Keyframe& keyframe = map_.keyframe(id);
    std::vector<Descriptor> descriptors;
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
        if (keyframe.landmarks[i] != no_landmark) {
            descriptors.push_back(keyframe.frame.descriptors[i]);
        }
    }
    return descriptors;
}

/** Length of the shortest way between two keyframes along the robot's path, with one loop as a
 *  short cut: drift can only have gathered on it. */
double LoopCloser::pathLength(int from, int to) const {
    const auto along = [&](int a, int b) { return std::abs(travelled_m_[a] - travelled_m_[b]); };
    double shortest = along(from, to);
    for (const PoseEdge& loop : loops_) {
        shortest = std::min(shortest, along(from, loop.from) + along(loop.to, to));
    }
    return shortest;
}

LoopCloser::Drift LoopCloser::greatestDrift(int from, int to) const {
    if (map_.keyframe(from).part != map_.keyframe(to).part) return anything;
    const double gathered = options_.loops.max_drift_share * pathLength(from, to);
    return {least_drift_m + gathered, least_drift_rad + gathered};
}

/** Whether a keyframe can share a view with a candidate if the map errs as much as it may. */
bool LoopCloser::mightSee(int keyframe, int candidate) const {
    const SE3 apart = map_.T_cam_world(candidate) * map_.T_cam_world(keyframe).inverse();
    const Drift drift = greatestDrift(candidate, keyframe);
    return apart.t.norm() <= widest_view_m + drift.m &&
           apart.angle() <= widest_view_rad + drift.rad;
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
    const auto neighbours = map_.covisible(keyframe, 1);
    const int newest = firstTooNear(keyframe);
    std::vector<int> candidates;
    for (const PlaceVote& vote : index_.query(placeDescriptors(keyframe))) {
        if (vote.votes < fewest_votes) break;
        if (static_cast<int>(candidates.size()) >= options_.loops.candidates) break;
        if (vote.keyframe >= newest) continue;
        if (map_.keyframe(vote.keyframe).culled || !mightSee(keyframe, vote.keyframe)) continue;
        const bool connected =
            std::any_of(neighbours.begin(), neighbours.end(),
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

/** Of places that look alike, the one that asks for least drift among those with many inliers;
 *  none when even that is more than the path explains. */
std::optional<LoopCloser::Loop> LoopCloser::likeliest(std::vector<Loop> loops) const {
    int most_inliers = 0;
    for (const Loop& loop : loops) most_inliers = std::max(most_inliers, loop.edge.inliers);
    std::optional<Loop> best;
    double least_share = 1;
    for (Loop& loop : loops) {
        if (loop.edge.inliers < contender_share * most_inliers) continue;
        const Drift greatest = greatestDrift(loop.edge.from, loop.edge.to);
        const double share = std::max(loop.asked.m / greatest.m, loop.asked.rad / greatest.rad);
        if (share > least_share) continue;
        least_share = share;
        best = std::move(loop);
    }
    return best;
}

/** Brings the odometer up to a keyframe. A weak link makes the way as unsure as many metres. */
void LoopCloser::travelTo(int keyframe) {
    if (travelled_m_.empty()) travelled_m_.push_back(0);
    for (int k = static_cast<int>(travelled_m_.size()); k <= keyframe; ++k) {
        const SE3 step = map_.T_cam_world(k - 1) * map_.T_cam_world(k).inverse();
        const double unsure = map_.keyframe(k).link == Link::Weak ? weak_link_m : 0;
        travelled_m_.push_back(travelled_m_.back() + step.t.norm() + unsure);
    }
}

void LoopCloser::forgetCulled() {
    const std::vector<int>& culled = map_.culled();
    for (; forgotten_ < culled.size(); ++forgotten_) index_.erase(culled[forgotten_]);
}

void LoopCloser::save(ByteWriter& out) const {
    index_.save(out);
    out.putCount(travelled_m_.size());
    for (const double m : travelled_m_) out.put(m);
    out.putCount(forgotten_);
    out.putCount(loops_.size());
    for (const PoseEdge& loop : loops_) put(loop, out);
}

void LoopCloser::load(ByteReader& in) {
    index_.load(in);
    travelled_m_.resize(in.getCount(sizeof(double)));
    for (double& m : travelled_m_) m = getFinite(in);
    forgotten_ = getIndex(in, map_.culled().size() + 1, "culled keyframe");
    const std::size_t loops = in.getCount(edge_bytes);
    for (std::size_t i = 0; i < loops; ++i) {
        loops_.push_back(getEdge(in, map_.keyframes().size(), EdgeKind::Loop));
    }
}

std::vector<PoseEdge> LoopCloser::findLoops(int keyframe) {
    travelTo(keyframe);
    forgetCulled();
    std::vector<Loop> verified;
    for (const int candidate : candidatesFor(keyframe)) {
        if (auto loop = verify(keyframe, candidate)) verified.push_back(std::move(*loop));
    }
    index_.insert(keyframe, placeDescriptors(keyframe));
    auto loop = likeliest(std::move(verified));
    if (!loop) return {};
    const PoseEdge edge = loop->edge;
    loops_.push_back(edge);
    unfused_.push_back(std::move(*loop));
    return {edge};
}

/** Aligns a frame with the landmarks of one keyframe. Only keypoints that can take part are
 *  compared: with depth on one side, with a landmark on the other. */
std::optional<LocatedFrame> LoopCloser::align(const Frame& frame, int candidate_id) const {
    const Keyframe& candidate = map_.keyframe(candidate_id);
    const Selection seen =
        select(frame, [&](std::size_t i) { return frame.keypoints[i].depth_m > 0; });
    const Selection known = select(
        candidate.frame, [&](std::size_t i) { return candidate.landmarks[i] != no_landmark; });
    std::vector<PointMatch> matches;
    std::vector<Eigen::Vector3d> points_cam;
    std::vector<std::pair<int, int>> used;  // keypoint, landmark
    for (const auto& [a, b] : matchMutually(seen.descriptors, known.descriptors,
                                            options_.tracker.max_hamming, place_match_ratio)) {
        const int keypoint = seen.keypoints[a];
        const int landmark = candidate.landmarks[known.keypoints[b]];
        const Keypoint& k = frame.keypoints[keypoint];
        matches.push_back({map_.landmark(landmark).position,
                           measurementOf(k, map_.scaleOf(k.octave), options_.sensor)});
        points_cam.push_back(camera_.unproject(k.u, k.v, k.depth_m));
        used.emplace_back(keypoint, landmark);
    }
    if (static_cast<int>(matches.size()) < fewest_aligned) return std::nullopt;
    const auto aligned =
        alignRobustly(camera_, matches, points_cam, options_.loops.ransac_iterations,
                      static_cast<std::uint64_t>(candidate_id));
    if (!aligned || aligned->inliers < fewest_aligned) return std::nullopt;
    LocatedFrame located;
    located.T_cam_world = solvePose(camera_, matches, aligned->T_cam_world).T_cam_world;
    located.landmarks.assign(frame.keypoints.size(), no_landmark);
    for (std::size_t m = 0; m < used.size(); ++m) {
        if (aligned->inlier[m]) located.landmarks[used[m].first] = used[m].second;
    }
    located.inliers = aligned->inliers;
    return located;
}

std::optional<LoopCloser::Loop> LoopCloser::verify(int id, int candidate) {
    const Frame& frame = map_.keyframe(id).frame;
    const auto aligned = align(frame, candidate);
    if (!aligned) return std::nullopt;
    const auto located = verifier_.trackLocalMap(frame, aligned->T_cam_world, aligned->landmarks,
                                                 PoseKernel::GemanMcClure);
    if (!located || located->inliers < options_.loops.min_inliers) return std::nullopt;
    const auto matches = matchesOf(frame, located->landmarks, map_, options_.sensor);
    Loop loop;
    loop.edge.from = candidate;
    loop.edge.to = id;
    loop.edge.T_from_to = map_.T_cam_world(candidate) * located->T_cam_world.inverse();
    loop.edge.information = solvePose(camera_, matches, located->T_cam_world).information;
    loop.edge.kind = EdgeKind::Loop;
    loop.edge.inliers = located->inliers;
    loop.asked = asked(loop.edge);
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

std::optional<LocatedFrame> LoopCloser::relocalise(const Frame& frame, Tracker& tracker) const {
    int tried = 0;
    for (const PlaceVote& vote : index_.query(frame.descriptors)) {
        if (vote.votes < fewest_votes || tried >= relocalisation_candidates) break;
        if (map_.keyframe(vote.keyframe).culled) continue;
        ++tried;
        const auto aligned = align(frame, vote.keyframe);
        if (!aligned) continue;
        auto located = tracker.trackLocalMap(frame, aligned->T_cam_world, aligned->landmarks);
        // As much proof as a loop needs: a wrong place is worse than none.
        if (located && located->inliers >= options_.loops.min_inliers) return located;
    }
    return std::nullopt;
}

Matrix6d LoopCloser::informationOf(int keyframe, const std::vector<int>& landmarks) const {
    const Keyframe& k = map_.keyframe(keyframe);
    const auto matches = matchesOf(k.frame, landmarks, map_, options_.sensor);
    if (static_cast<int>(matches.size()) < fewest_for_information) {
        return informationFrom(weak_sigma);
    }
    // Both keyframes measure the landmarks, so the relative pose has twice the variance of one.
    return 0.5 * solvePose(camera_, matches, k.T_cam_world).information;
}

PoseEdge LoopCloser::odometryEdge(int keyframe) const {
    PoseEdge edge;
    edge.from = keyframe - 1;
    edge.to = keyframe;
    edge.T_from_to = map_.T_cam_world(edge.from) * map_.T_cam_world(keyframe).inverse();
    const std::vector<int> shared = sharedLandmarks(keyframe, edge.from);
    edge.inliers = static_cast<int>(
        std::count_if(shared.begin(), shared.end(), [](int id) { return id != no_landmark; }));
    const bool measured =
        map_.keyframe(keyframe).link != Link::None || edge.inliers >= fewest_for_information;
    edge.information = measured ? informationOf(keyframe, shared) : informationFrom(unknown_sigma);
    return edge;
}

/** Landmarks of a keyframe, one a keypoint, without those that the other does not see. */
std::vector<int> LoopCloser::sharedLandmarks(int keyframe, int other) const {
    std::vector<int> shared = map_.keyframe(keyframe).landmarks;
    for (int& landmark : shared) {
        if (landmark == no_landmark || map_.keypointOf(landmark, other) >= 0) continue;
        landmark = no_landmark;
    }
    return shared;
}

PoseGraph LoopCloser::poseGraph() const {
    PoseGraph graph;
    const int keyframes = static_cast<int>(map_.keyframes().size());
    for (int k = 0; k < keyframes; ++k) graph.nodes.push_back(map_.T_cam_world(k).inverse());
    for (int k = 1; k < keyframes; ++k) {
        graph.edges.push_back(odometryEdge(k));
        const bool follows = map_.keyframe(k).link == Link::Tracked;
        const PoseEdge odometry = graph.edges.back();
        for (const Covisibility& c :
             map_.covisible(k, follows ? strong_covisibility : fewest_that_tie)) {
            if (c.keyframe >= k - 1) continue;
            PoseEdge edge = odometry;
            if (!follows) edge.information = informationOf(k, sharedLandmarks(k, c.keyframe));
            edge.from = c.keyframe;
            edge.to = k;
            edge.T_from_to = map_.T_cam_world(c.keyframe) * map_.T_cam_world(k).inverse();
            edge.kind = EdgeKind::Covisibility;
            edge.inliers = c.shared;
            graph.edges.push_back(edge);
        }
    }
    graph.edges.insert(graph.edges.end(), loops_.begin(), loops_.end());
    return graph;
}

void LoopCloser::correct(const std::vector<SE3>& T_world_keyframe, LocalMapper& mapper) {
    std::vector<SE3> moved;
    for (const Keyframe& keyframe : map_.keyframes()) {
        moved.push_back(T_world_keyframe[keyframe.id] * map_.T_cam_world(keyframe.id));
    }
    for (std::size_t id = 0; id < map_.landmarks().size(); ++id) {
        Landmark& landmark = map_.landmark(static_cast<int>(id));
        if (!landmark.alive) continue;
        const SE3& motion = moved[landmark.observations.back().keyframe];
        landmark.position = motion * landmark.position;
        landmark.view_direction = motion.R * landmark.view_direction;
    }
    for (const Keyframe& keyframe : map_.keyframes()) {
        if (!keyframe.culled) map_.setPose(keyframe.id, T_world_keyframe[keyframe.id].inverse());
    }
    for (const Loop& loop : std::exchange(unfused_, {})) {
        if (followed(loop)) {
            fuse(loop, mapper);
        } else {
            forget(loop.edge);
        }
    }
}

/** What a loop asks of the map as it is: how far its later keyframe would have to move. */
LoopCloser::Drift LoopCloser::asked(const PoseEdge& loop) const {
    const SE3 T_from_to = map_.T_cam_world(loop.from) * map_.T_cam_world(loop.to).inverse();
    const SE3 move = loop.T_from_to.inverse() * T_from_to;
    return {move.t.norm(), move.angle()};
}

/** A loop that the robust graph left unheeded contradicts all the others. */
bool LoopCloser::followed(const Loop& loop) const {
    return asked(loop.edge).m < std::max(unheeded_m, unheeded_share * loop.asked.m);
}

void LoopCloser::forget(const PoseEdge& edge) {
    const auto same = [&](const PoseEdge& e) { return e.from == edge.from && e.to == edge.to; };
    loops_.erase(std::remove_if(loops_.begin(), loops_.end(), same), loops_.end());
}

/** What verification matched is one landmark, whatever distance the drift put between the two. */
void LoopCloser::fuse(const Loop& loop, LocalMapper& mapper) {
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
    auto neighbours = map_.covisible(keyframe);
    if (neighbours.size() > fused_neighbours) neighbours.resize(fused_neighbours);
    mapper.joinInto(keyframe, loop.landmarks);
    for (const Covisibility& c : neighbours) mapper.joinInto(c.keyframe, loop.landmarks);
}

}  // namespace rgbd_graphslam
