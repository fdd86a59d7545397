#include "rgbd_graphslam/graphslam/deciders.h"

#include <mrpt/obs/obs_utils.h>

#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;
namespace {

/** Warnings of MRPT's deciders tell of what is as it should be, and every record is kept. */
template <class Decider>
void nameAndHush(Decider& decider, const char* name) {
    decider.setClassName(name);
    decider.setMinLoggingLevel(mrpt::system::LVL_ERROR);
}

void track(SharedSlam& shared, const CObservation3DRangeScan::Ptr& frame) {
    if (!shared.slam) startSlam(shared, Rig{{rigCameraOf(*frame)}});
    if (!shared.prepared) shared.prepared = shared.slam->prepare(toTrackingImage(frame));
    Frame prepared = std::move(*shared.prepared);
    shared.prepared.reset();
    shared.last = shared.slam->track(std::move(prepared));
    shared.new_keyframe = shared.last.keyframe;
    if (shared.on_pose) shared.on_pose(shared.last);
}

}  // namespace

COrbKeyframeNRD::COrbKeyframeNRD() {
    nameAndHush(*this, "COrbKeyframeNRD");
}

void COrbKeyframeNRD::loadParams(const std::string& ini) {
    IniFile::fromFile(ini).loadKnown(m_graph->shared->options.all());
}

bool COrbKeyframeNRD::updateState(mrpt::obs::CActionCollection::Ptr,
                                  mrpt::obs::CSensoryFrame::Ptr observations,
                                  mrpt::obs::CObservation::Ptr observation) {
    SharedSlam& shared = *m_graph->shared;
    shared.new_keyframe.reset();
    const auto frame =
        mrpt::obs::utils::getObservation<CObservation3DRangeScan>(observations, observation);
    if (!frame) return false;
    track(shared, frame);
    if (shared.new_keyframe.value_or(0) == 0) return false;
    return registerNewNodeAtEnd(
        registered(shared.slam->odometryEdge(*shared.new_keyframe), shared));
}

COrbKeyframeNRD::global_pose_t COrbKeyframeNRD::getCurrentRobotPosEstimation() const {
    const SharedSlam& shared = *m_graph->shared;
    if (!shared.slam) return {};
    const bool registers_root = m_prev_registered_nodeID == mrpt::graphs::INVALID_NODEID;
    const SE3 T_world_cam = registers_root && shared.new_keyframe
                                ? shared.slam->keyframes().front().T_world_cam
                                : shared.last.T_world_cam;
    return global_pose_t(robotPose(T_world_cam, shared.T_base_cam));
}

COrbLoopClosureERD::COrbLoopClosureERD() {
    nameAndHush(*this, "COrbLoopClosureERD");
}

bool COrbLoopClosureERD::updateState(mrpt::obs::CActionCollection::Ptr,
                                     mrpt::obs::CSensoryFrame::Ptr, mrpt::obs::CObservation::Ptr) {
    SharedSlam& shared = *m_graph->shared;
    shared.loops_found = false;
    if (shared.new_keyframe) {
        for (const PoseEdge& loop : shared.slam->closeLoops(*shared.new_keyframe)) {
            registerNewEdge(loop.from, loop.to, registered(loop, shared));
        }
    }
    m_just_inserted_lc = shared.loops_found;
    return true;
}

void COrbLoopClosureERD::registerNewEdge(const mrpt::graphs::TNodeID& from,
                                         const mrpt::graphs::TNodeID& to,
                                         const constraint_t& edge) {
    m_graph->insertEdge(from, to, edge);
    m_graph->shared->loops_found = true;
}

void COrbLoopClosureERD::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const {
    (*edge_type_to_num)["lc"] = static_cast<int>(m_graph->shared->slam->loops().size());
}

CCeresGSO::CCeresGSO() {
    nameAndHush(*this, "CCeresGSO");
}

bool CCeresGSO::updateState(mrpt::obs::CActionCollection::Ptr, mrpt::obs::CSensoryFrame::Ptr,
                            mrpt::obs::CObservation::Ptr) {
    just_optimized_ = m_graph->shared->loops_found;
    if (just_optimized_) optimizeGraph();
    return true;
}

void CCeresGSO::optimizeGraph() {
    dropForgottenLoops(*m_graph);
    updateNodes(*m_graph);
}

}  // namespace rgbd_graphslam
