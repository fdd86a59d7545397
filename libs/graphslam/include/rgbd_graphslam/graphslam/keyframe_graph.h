/** The pose graph as MRPT sees it. */
#pragma once
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** What the deciders and the optimizer of one graph share. */
struct SharedSlam {
    SlamOptions options;
    /** Made from the calibration of the first frame. */
    std::unique_ptr<VisualSlam> slam;
    SE3 T_base_cam;
    /** Features of the coming frame where they were made ahead of it. */
    std::optional<Frame> prepared;
    TrackedFrame last;
    /** See GraphSlamSession::onPose(). */
    std::function<void(const TrackedFrame&)> on_pose;
    /** Keyframe that the present step has made. */
    std::optional<int> new_keyframe;
    /** Of the graph, between cameras, in the order in which they came. */
    std::vector<PoseEdge> edges;
    /** Whether the present step has added loop edges. */
    bool loops_found = false;
};

/** A graph whose nodes are robot poses (x forward, y left, z up) at the keyframes: node i is
 *  keyframe i, in a world that is the robot's first pose. It carries the SLAM it is built by, since
 *  the graph is what MRPT's engine hands to every decider. */
struct KeyframeGraph : mrpt::graphs::CNetworkOfPoses3DInf {
    std::shared_ptr<SharedSlam> shared = std::make_shared<SharedSlam>();

    /** MRPT's engine calls this after each new node, which would throw the optimized poses away. */
    template <class... Arguments>
    void dijkstra_nodes_estimate(Arguments&&...) {}
};

/** Starts the SLAM of a graph. \param rig cameras on the robot */
void startSlam(SharedSlam& shared, const Rig& rig);

/** A map that a run starts from. */
struct StartMap {
    MapSnapshot map;
    MapUse use = MapUse::Localize;
};

/** Starts in a map, which fills the graph with its keyframes, odometry and loops.
 *  \throws Error when the map does not fit the options or the camera */
void startSlam(KeyframeGraph& graph, const Rig& rig, StartMap start);

/** Robot pose in the graph's world. \param T_world_cam in the world of VisualSlam */
mrpt::poses::CPose3D robotPose(const SE3& T_world_cam, const SE3& T_base_cam);

/** The edge between robot poses that says the same as one between cameras; its information is
 *  carried over to MRPT's parameters (x, y, z, yaw, pitch, roll) to first order. */
KeyframeGraph::constraint_t robotEdge(const PoseEdge& edge, const SE3& T_base_cam);

/** Keeps an edge for save(). \return what the graph gets */
KeyframeGraph::constraint_t registered(const PoseEdge& edge, SharedSlam& shared);

/** The SLAM and the graph's edges. */
void save(const KeyframeGraph& graph, ByteWriter& out);
/** Into a graph without nodes whose SLAM was started. \throws DamagedBytes */
void load(ByteReader& in, KeyframeGraph& graph);

/** Takes out the edges of loops that the SLAM has dropped as contradicting the rest. */
void dropForgottenLoops(KeyframeGraph& graph);

/** Moves the nodes to where the SLAM has its keyframes now. */
void updateNodes(KeyframeGraph& graph);

}  // namespace rgbd_graphslam
