#include "rgbd_graphslam/slam/loop_closer.h"

#include <algorithm>

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

/** Best-voted earlier keyframes that the map does not connect with this one yet. */
std::vector<int> LoopCloser::candidatesFor(int keyframe) const {
    const auto neighbours = map_.covisible(keyframe, 1);
    std::vector<int> candidates;
    for (const PlaceVote& vote : index_.query(placeDescriptors(keyframe))) {
        if (vote.votes < fewest_votes) break;
        if (static_cast<int>(candidates.size()) >= options_.loops.candidates) break;
        if (vote.keyframe > keyframe - options_.loops.min_keyframe_gap) continue;
        if (map_.keyframe(vote.keyframe).culled) continue;
        const bool connected =
            std::any_of(neighbours.begin(), neighbours.end(),
                        [&](const Covisibility& c) { return c.keyframe == vote.keyframe; });
        if (!connected) candidates.push_back(vote.keyframe);
    }
    return candidates;
}

std::vector<PoseEdge> LoopCloser::findLoops(int keyframe) {
    std::vector<PoseEdge> found;
    for (const int candidate : candidatesFor(keyframe)) {
        auto loop = verify(keyframe, candidate);
        if (!loop) continue;
        found.push_back(loop->edge);
        loops_.push_back(loop->edge);
        unfused_.push_back(std::move(*loop));
        break;
    }
    index_.insert(keyframe, placeDescriptors(keyframe));
    return found;
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
    const auto located = verifier_.trackLocalMap(frame, aligned->T_cam_world, aligned->landmarks);
    if (!located || located->inliers < options_.loops.min_inliers) return std::nullopt;
    const auto matches = matchesOf(frame, located->landmarks, map_, options_.sensor);
    Loop loop;
    loop.edge.from = candidate;
    loop.edge.to = id;
    loop.edge.T_from_to = map_.T_cam_world(candidate) * located->T_cam_world.inverse();
    loop.edge.information = solvePose(camera_, matches, located->T_cam_world).information;
    loop.edge.kind = EdgeKind::Loop;
    loop.edge.inliers = located->inliers;
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
        return weak_sigma.cwiseProduct(weak_sigma).cwiseInverse().asDiagonal();
    }
    // Both keyframes measure the landmarks, so the relative pose has twice the variance of one.
    return 0.5 * solvePose(camera_, matches, k.T_cam_world).information;
}

PoseEdge LoopCloser::odometryEdge(int keyframe) const {
    PoseEdge edge;
    edge.from = keyframe - 1;
    edge.to = keyframe;
    edge.T_from_to = map_.T_cam_world(edge.from) * map_.T_cam_world(keyframe).inverse();
    std::vector<int> shared = map_.keyframe(keyframe).landmarks;
    for (int& landmark : shared) {
        if (landmark == no_landmark || map_.keypointOf(landmark, edge.from) >= 0) continue;
        landmark = no_landmark;
    }
    edge.inliers = static_cast<int>(
        std::count_if(shared.begin(), shared.end(), [](int id) { return id != no_landmark; }));
    edge.information = informationOf(keyframe, shared);
    return edge;
}

PoseGraph LoopCloser::poseGraph() const {
    PoseGraph graph;
    const int keyframes = static_cast<int>(map_.keyframes().size());
    for (int k = 0; k < keyframes; ++k) graph.nodes.push_back(map_.T_cam_world(k).inverse());
    for (int k = 1; k < keyframes; ++k) {
        graph.edges.push_back(odometryEdge(k));
        for (const Covisibility& c : map_.covisible(k, strong_covisibility)) {
            if (c.keyframe >= k - 1) continue;
            PoseEdge edge = graph.edges.back();
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
    for (const Loop& loop : unfused_) {
        mapper.joinInto(loop.edge.to, loop.landmarks);
        auto neighbours = map_.covisible(loop.edge.to);
        if (neighbours.size() > fused_neighbours) neighbours.resize(fused_neighbours);
        for (const Covisibility& c : neighbours) mapper.joinInto(c.keyframe, loop.landmarks);
    }
    unfused_.clear();
}

}  // namespace rgbd_graphslam
