/** MRPT's graph-SLAM deciders and optimizer over VisualSlam. This header is heavy and, as all of
 *  mrpt-graphslam's, opens namespaces: include it in few .cpp files. */
#pragma once
#include <mrpt/graphslam/interfaces/CEdgeRegistrationDecider.h>
#include <mrpt/graphslam/interfaces/CGraphSlamOptimizer.h>
#include <mrpt/graphslam/interfaces/CNodeRegistrationDecider.h>

#include <map>
#include <string>

#include "rgbd_graphslam/graphslam/keyframe_graph.h"

namespace rgbd_graphslam {

/** Tracks every RGB-D frame; a keyframe becomes a node with an odometry edge. MRPT's engine wants
 *  exactly two nodes first, so keyframe 0 waits for keyframe 1. */
class COrbKeyframeNRD : public mrpt::graphslam::deciders::CNodeRegistrationDecider<KeyframeGraph> {
  public:
    COrbKeyframeNRD();

    /** \return whether a node was registered */
    bool updateState(mrpt::obs::CActionCollection::Ptr action,
                     mrpt::obs::CSensoryFrame::Ptr observations,
                     mrpt::obs::CObservation::Ptr observation) override;
    /** Reads the sections of SlamOptions from an ini file that may hold others too. */
    void loadParams(const std::string& ini) override;
    /** The graph has nodes already, up to `last`. */
    void continueAfter(mrpt::graphs::TNodeID last) { m_prev_registered_nodeID = last; }
    /** Of the last frame. */
    global_pose_t getCurrentRobotPosEstimation() const override;
};

/** Closes loops at each new keyframe and adds the verified edges. */
class COrbLoopClosureERD
    : public mrpt::graphslam::deciders::CEdgeRegistrationDecider<KeyframeGraph> {
  public:
    COrbLoopClosureERD();

    /** \return true */
    bool updateState(mrpt::obs::CActionCollection::Ptr action,
                     mrpt::obs::CSensoryFrame::Ptr observations,
                     mrpt::obs::CObservation::Ptr observation) override;
    void getEdgesStats(std::map<std::string, int>* edge_type_to_num) const override;

  protected:
    void registerNewEdge(const mrpt::graphs::TNodeID& from, const mrpt::graphs::TNodeID& to,
                         const constraint_t& edge) override;
};

/** Moves the nodes to where a closed loop has put the keyframes. The SLAM optimizes its pose graph
 *  itself (Ceres), because its map moves with it. */
class CCeresGSO : public mrpt::graphslam::optimizers::CGraphSlamOptimizer<KeyframeGraph> {
  public:
    CCeresGSO();

    /** \return true */
    bool updateState(mrpt::obs::CActionCollection::Ptr action,
                     mrpt::obs::CSensoryFrame::Ptr observations,
                     mrpt::obs::CObservation::Ptr observation) override;
    bool justFullyOptimizedGraph() const override { return just_optimized_; }

  protected:
    void optimizeGraph() override;

  private:
    bool just_optimized_ = false;
};

}  // namespace rgbd_graphslam
