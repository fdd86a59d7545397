#include "rgbd_graphslam/graphslam/keyframe_graph.h"

#include <algorithm>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Angular velocity in the reference frame for rates of yaw, pitch and roll. */
Eigen::Matrix3d angularVelocityOfRates(double yaw, double pitch) {
    const Eigen::Matrix3d Rz = rotationExp({0, 0, yaw});
    const Eigen::Matrix3d Ry = rotationExp({0, pitch, 0});
    Eigen::Matrix3d rates;
    rates << Eigen::Vector3d::UnitZ(), Rz.col(1), Rz * Ry.col(0);
    return rates;
}

/** Derivative of a camera edge's tangent vector with respect to (x, y, z, yaw, pitch, roll) of the
 *  robot edge T_base_cam * T_from_to * T_base_cam^-1. */
Matrix6d tangentOfParameters(const SE3& T_from_to, const SE3& T_base_cam,
                             const mrpt::poses::CPose3D& robot_edge) {
    const Eigen::Matrix3d to_tangent = (T_base_cam.R * T_from_to.R).transpose();
    const Eigen::Matrix3d rotation =
        to_tangent * angularVelocityOfRates(robot_edge.yaw(), robot_edge.pitch());
    Matrix6d derivative;
    derivative << to_tangent, skew(T_base_cam.inverse().t) * rotation, Eigen::Matrix3d::Zero(),
        rotation;
    return derivative;
}

void insert(const PoseEdge& edge, KeyframeGraph& graph) {
    graph.insertEdge(edge.from, edge.to, registered(edge, *graph.shared));
}

}  // namespace

void startSlam(SharedSlam& shared, const Rig& rig) {
    shared.T_base_cam = rig.cameras.front().T_body_cam;
    shared.slam = std::make_unique<VisualSlam>(shared.options, rig);
}

void startSlam(KeyframeGraph& graph, const Rig& rig, StartMap start) {
    SharedSlam& shared = *graph.shared;
    shared.T_base_cam = rig.cameras.front().T_body_cam;
    shared.slam =
        std::make_unique<VisualSlam>(shared.options, rig, std::move(start.map), start.use);
    for (const KeyframeView& keyframe : shared.slam->keyframes()) {
        graph.nodes[keyframe.id] = {};
        if (keyframe.id > 0) insert(shared.slam->odometryEdge(keyframe.id), graph);
    }
    for (const PoseEdge& loop : shared.slam->loops()) insert(loop, graph);
    updateNodes(graph);
}

mrpt::poses::CPose3D robotPose(const SE3& T_world_cam, const SE3& T_base_cam) {
    return toCPose3D(T_base_cam * T_world_cam * T_base_cam.inverse());
}

KeyframeGraph::constraint_t robotEdge(const PoseEdge& edge, const SE3& T_base_cam) {
    KeyframeGraph::constraint_t result;
    result.mean = robotPose(edge.T_from_to, T_base_cam);
    const Matrix6d derivative = tangentOfParameters(edge.T_from_to, T_base_cam, result.mean);
    const Matrix6d information = derivative.transpose() * edge.information * derivative;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) result.cov_inv(i, j) = information(i, j);
    }
    return result;
}

KeyframeGraph::constraint_t registered(const PoseEdge& edge, SharedSlam& shared) {
    shared.edges.push_back(edge);
    return robotEdge(edge, shared.T_base_cam);
}

void save(const KeyframeGraph& graph, ByteWriter& out) {
    const SharedSlam& shared = *graph.shared;
    shared.slam->save(out);
    out.putCount(graph.nodes.size());
    out.putCount(shared.edges.size());
    for (const PoseEdge& edge : shared.edges) {
        putFlag(edge.kind == EdgeKind::Loop, out);
        put(edge, out);
    }
}

void load(ByteReader& in, KeyframeGraph& graph) {
    SharedSlam& shared = *graph.shared;
    shared.slam->load(in);
    const int keyframes = static_cast<int>(shared.slam->keyframes().size());
    const int nodes = getIndex(in, keyframes + 1, "node");
    for (int id = 0; id < nodes; ++id) graph.nodes[id] = {};
    const std::size_t edges = in.getCount(edge_bytes);
    for (std::size_t e = 0; e < edges; ++e) {
        const EdgeKind kind = getFlag(in) ? EdgeKind::Loop : EdgeKind::Sequential;
        insert(getEdge(in, nodes, kind), graph);
    }
    updateNodes(graph);
}

void dropForgottenLoops(KeyframeGraph& graph) {
    SharedSlam& shared = *graph.shared;
    const auto& loops = shared.slam->loops();
    const auto forgotten = [&](const PoseEdge& edge) {
        const auto same = [&](const PoseEdge& loop) {
            return loop.from == edge.from && loop.to == edge.to;
        };
        return edge.kind == EdgeKind::Loop && std::none_of(loops.begin(), loops.end(), same);
    };
    for (const PoseEdge& edge : shared.edges) {
        if (forgotten(edge)) graph.edges.erase({edge.from, edge.to});
    }
    shared.edges.erase(std::remove_if(shared.edges.begin(), shared.edges.end(), forgotten),
                       shared.edges.end());
}

void updateNodes(KeyframeGraph& graph) {
    const SharedSlam& shared = *graph.shared;
    for (const KeyframeView& keyframe : shared.slam->keyframes()) {
        const auto node = graph.nodes.find(keyframe.id);
        if (node == graph.nodes.end()) continue;
        static_cast<mrpt::poses::CPose3D&>(node->second) =
            robotPose(keyframe.T_world_cam, shared.T_base_cam);
    }
}

}  // namespace rgbd_graphslam
