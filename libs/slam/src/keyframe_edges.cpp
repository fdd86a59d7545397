#include "keyframe_edges.h"

#include <algorithm>

#include "rgbd_graphslam/estimation/pose_solver.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {
namespace {

constexpr int strong_covisibility = 100;
/** What an edge is worth when two keyframes share too little to tell: 5 cm, 3 degrees. */
const Vector6d dead_reckoned_sigma = (Vector6d() << 0.05, 0.05, 0.05, 0.05, 0.05, 0.05).finished();
constexpr int fewest_for_information = 10;
/** The same where nothing was measured between them: 10 m, 3 rad. */
const Vector6d unknown_sigma = (Vector6d() << 10, 10, 10, 3, 3, 3).finished();
/** What ties a keyframe that does not follow the one before. */
constexpr int fewest_that_tie = 15;

Matrix6d informationFrom(const Vector6d& sigma) {
    return sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
}

}  // namespace

Matrix6d KeyframeEdges::informationOf(int keyframe, const std::vector<int>& landmarks) const {
    const Keyframe& k = map_.keyframe(keyframe);
    const auto matches = matchesOf(k.frame, landmarks, map_, sensor_);
    if (static_cast<int>(matches.size()) < fewest_for_information) {
        return informationFrom(dead_reckoned_sigma);
    }
    // Both keyframes measure the landmarks, so the relative pose has twice the variance of one.
    return 0.5 * solvePose(cameras_.mounted(), matches, k.T_cam_world).information;
}

/** Landmarks of a keyframe, one per keypoint, without those that the other does not see. */
std::vector<int> KeyframeEdges::sharedLandmarks(int keyframe, int other) const {
    std::vector<int> shared = map_.keyframe(keyframe).landmarks;
    for (int& landmark : shared) {
        if (landmark == no_landmark || map_.keypointOf(landmark, other) >= 0) continue;
        landmark = no_landmark;
    }
    return shared;
}

PoseEdge KeyframeEdges::odometry(int keyframe) const {
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

/** Whether the keyframe before tells what a keyframe's ties are worth. */
bool KeyframeEdges::follows(int keyframe) const {
    return map_.keyframe(keyframe).link == Link::Tracked && !map_.keyframe(keyframe - 1).culled;
}

/** Keyframes before the last one that see the same as `keyframe`. */
std::vector<Covisibility> KeyframeEdges::fartherThanLast(int keyframe) const {
    auto farther =
        map_.covisible(keyframe, follows(keyframe) ? strong_covisibility : fewest_that_tie);
    const auto too_near = [&](const Covisibility& c) { return c.keyframe >= keyframe - 1; };
    farther.erase(std::remove_if(farther.begin(), farther.end(), too_near), farther.end());
    return farther;
}

/** From keyframes before the last one. Where tracking ties a keyframe to the last one, its odometry
 *  tells what they are worth. */
std::vector<PoseEdge> KeyframeEdges::covisibility(const PoseEdge& odometry) const {
    const int keyframe = odometry.to;
    const bool as_odometry = follows(keyframe);
    std::vector<PoseEdge> edges;
    for (const Covisibility& c : fartherThanLast(keyframe)) {
        PoseEdge edge = odometry;
        if (!as_odometry) {
            edge.information = informationOf(keyframe, sharedLandmarks(keyframe, c.keyframe));
        }
        edge.from = c.keyframe;
        edge.T_from_to = map_.T_cam_world(c.keyframe) * map_.T_cam_world(keyframe).inverse();
        edge.kind = EdgeKind::Covisibility;
        edge.inliers = c.shared;
        edges.push_back(edge);
    }
    return edges;
}

/** All edges from earlier keyframes that one keyframe has. They share its measurements, and those
 * of its neighbors share most landmarks: m edges per keyframe, over 1 to m keyframes each, would
 * make the chain m^2/3 times as stiff as one independent measurement per m keyframes, which is what
 * there is. */
std::vector<PoseEdge> KeyframeEdges::edgesTo(int keyframe) const {
    std::vector<PoseEdge> edges{odometry(keyframe)};
    const std::vector<PoseEdge> farther = covisibility(edges.front());
    edges.insert(edges.end(), farther.begin(), farther.end());
    const double m = static_cast<double>(edges.size());
    for (PoseEdge& edge : edges) edge.information *= std::min(1.0, 3 / (m * m));
    return edges;
}

PoseGraph KeyframeEdges::graph(const std::vector<PoseEdge>& loops) const {
    PoseGraph graph;
    const int keyframes = static_cast<int>(map_.keyframes().size());
    for (int k = 0; k < keyframes; ++k) graph.nodes.push_back(map_.T_cam_world(k).inverse());
    graph.fixed = map_.fixedCount();
    for (int k = std::max(1, graph.fixed); k < keyframes; ++k) {
        const std::vector<PoseEdge> edges = edgesTo(k);
        graph.edges.insert(graph.edges.end(), edges.begin(), edges.end());
    }
    graph.edges.insert(graph.edges.end(), loops.begin(), loops.end());
    return graph;
}

std::vector<std::pair<int, int>> KeyframeEdges::covisiblePairs() const {
    std::vector<std::pair<int, int>> pairs;
    const int keyframes = static_cast<int>(map_.keyframes().size());
    for (int k = std::max(1, map_.fixedCount()); k < keyframes; ++k) {
        for (const Covisibility& c : fartherThanLast(k)) pairs.emplace_back(c.keyframe, k);
    }
    return pairs;
}

}  // namespace rgbd_graphslam
