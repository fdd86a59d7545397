#include "rgbd_graphslam/graphslam/graph_slam_session.h"

#include <fcntl.h>
#include <mrpt/graphslam/CGraphSlamEngine.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/graphslam/deciders.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;
namespace {

/** The standard streams are /dev/null while this lives. */
class StandardStreamsAway {
  public:
    StandardStreamsAway() {
        flush();
        const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
        for (int fd = 0; fd < streams; ++fd) {
            kept_[fd] = fcntl(fd, F_DUPFD_CLOEXEC, streams);
            if (kept_[fd] >= 0) dup2(nothing, fd);
        }
        close(nothing);
    }
    ~StandardStreamsAway() {
        flush();
        for (int fd = 0; fd < streams; ++fd) {
            if (kept_[fd] < 0) continue;
            dup2(kept_[fd], fd);
            close(kept_[fd]);
        }
        clearerr(stdin);
        std::cin.clear();
    }
    StandardStreamsAway(const StandardStreamsAway&) = delete;
    StandardStreamsAway& operator=(const StandardStreamsAway&) = delete;

  private:
    static constexpr int streams = 3;
    static void flush() {
        std::cout.flush();
        std::cerr.flush();
        std::fflush(nullptr);
    }
    int kept_[streams];
};

class KeyframeEngine : public mrpt::graphslam::CGraphSlamEngine<KeyframeGraph> {
  public:
    /** The engine wants an ini file; an empty one leaves all to our options. */
    KeyframeEngine(COrbKeyframeNRD& nodes, COrbLoopClosureERD& edges, CCeresGSO& optimizer)
        : CGraphSlamEngine("/dev/null", "", "", nullptr, &nodes, &edges, &optimizer) {
        setMinLoggingLevel(mrpt::system::LVL_ERROR);
        m_time_logger.disable();  // it would print its table at the end
    }
    KeyframeGraph& graph() { return m_graph; }

    /** The graph was filled with nodes; the next one is no first one. */
    void continueAfterNodes() {
        m_nodeID_max = m_graph.nodeCount() - 1;
        m_is_first_time_node_reg = false;
    }
};

}  // namespace

class GraphSlamSession::Implementation {
  public:
    Implementation(const SlamOptions& options, const Rig& rig, std::optional<StartMap> start) {
        {
            const StandardStreamsAway away;
            engine_ = std::make_unique<KeyframeEngine>(nodes_, edges_, optimizer_);
        }
        shared().options = options;
        if (start) {
            startSlam(graph(), rig, std::move(*start));
        } else {
            startSlam(shared(), rig);
        }
        continueAfterNodes();
    }

    void load(ByteReader& in) {
        rgbd_graphslam::load(in, graph());
        continueAfterNodes();
    }

    SharedSlam& shared() { return *engine_->graph().shared; }
    KeyframeGraph& graph() { return engine_->graph(); }

    void step(const CObservation3DRangeScan::Ptr& observation) {
        mrpt::obs::CObservation::Ptr entry = observation;
        std::size_t number = steps_++;
        try {
            engine_->execGraphSlamStep(entry, number);
        } catch (const mrpt::ExceptionWithCallBackBase& e) {
            throw Error(e.originalWhat);
        }
    }

    /** The engine wants two nodes at first; a run with one keyframe has a graph too. */
    KeyframeGraph completeGraph() {
        KeyframeGraph complete = graph();
        const bool has_keyframe = !shared().slam->keyframes().empty();
        if (complete.nodes.empty() && has_keyframe) complete.nodes[complete.root] = {};
        updateNodes(complete);
        return complete;
    }

  private:
    void continueAfterNodes() {
        if (graph().nodes.empty()) return;
        nodes_.continueAfter(graph().nodeCount() - 1);
        engine_->continueAfterNodes();
    }

    COrbKeyframeNRD nodes_;
    COrbLoopClosureERD edges_;
    CCeresGSO optimizer_;
    std::unique_ptr<KeyframeEngine> engine_;
    std::size_t steps_ = 0;
};

GraphSlamSession::GraphSlamSession(const SlamOptions& options, const Rig& rig)
    : impl_(std::make_unique<Implementation>(options, rig, std::nullopt)) {}

GraphSlamSession::GraphSlamSession(const SlamOptions& options,
                                   const CObservation3DRangeScan& first_frame)
    : GraphSlamSession(options, Rig{{rigCameraOf(first_frame)}}) {}

GraphSlamSession::GraphSlamSession(const SlamOptions& options, const Rig& rig, MapSnapshot map,
                                   MapUse use)
    : impl_(std::make_unique<Implementation>(options, rig, StartMap{std::move(map), use})) {}

GraphSlamSession::~GraphSlamSession() = default;

Frame GraphSlamSession::prepare(const RgbdImage& image) const {
    return slam().prepare(image);
}

Frame GraphSlamSession::prepare(const std::vector<CameraImage>& images) const {
    return slam().prepare(images);
}

TrackedFrame GraphSlamSession::step(const CObservation3DRangeScan::Ptr& observation,
                                    Frame prepared) {
    impl_->shared().prepared = std::move(prepared);
    impl_->step(observation);
    return impl_->shared().last;
}

TrackedFrame GraphSlamSession::step(const CObservation3DRangeScan::Ptr& observation) {
    return step(observation, prepare(toTrackingImage(observation)));
}

void GraphSlamSession::onPose(std::function<void(const TrackedFrame&)> take) {
    impl_->shared().on_pose = std::move(take);
}

void GraphSlamSession::finish() {
    impl_->shared().slam->finish();
    updateNodes(impl_->graph());
}

void GraphSlamSession::save(ByteWriter& out) const {
    rgbd_graphslam::save(impl_->graph(), out);
}

void GraphSlamSession::load(ByteReader& in) {
    impl_->load(in);
}

const VisualSlam& GraphSlamSession::slam() const {
    return *impl_->shared().slam;
}

const SE3& GraphSlamSession::T_base_cam() const {
    return impl_->shared().T_base_cam;
}

void GraphSlamSession::writeGraph(const std::string& path, const SE3& T_out_world) const {
    KeyframeGraph graph = impl_->completeGraph();
    const mrpt::poses::CPose3D T_out_graph =
        toCPose3D(T_out_world * impl_->shared().T_base_cam.inverse());
    for (auto& [id, node] : graph.nodes) {
        static_cast<mrpt::poses::CPose3D&>(node) = T_out_graph + node;
    }
    writeAtomically(path, [&](const std::string& temporary) {
        graph.saveToTextFile(temporary);
        return true;
    });
}

}  // namespace rgbd_graphslam
