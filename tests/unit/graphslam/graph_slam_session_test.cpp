#include "rgbd_graphslam/graphslam/graph_slam_session.h"

#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>

#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/estimation/pose_graph.h"

namespace rgbd_graphslam {
namespace {

constexpr double turn_rad = 0.05;
/** One round takes 126 frames. */
constexpr int whole_film = 140;

const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& film() {
    static const auto frames = filmRoundTrip(whole_film, turn_rad);
    return frames;
}

/** A session that has seen the film. */
class SeenRoom : public testing::Test {
  protected:
    SeenRoom() : session_(SlamOptions(), *film().front()) {
        for (const auto& frame : film()) {
            const TrackedFrame tracked = session_.step(frame);
            all_tracked_ &= tracked.origin == FrameOrigin::Tracked;
        }
        session_.finish();
    }
    mrpt::graphs::CNetworkOfPoses3DInf writtenGraph(const SE3& T_out_world) const {
        const TestFolder folder;
        session_.writeGraph(folder / "a.graph", T_out_world);
        mrpt::graphs::CNetworkOfPoses3DInf graph;
        graph.loadFromTextFile(folder / "a.graph");
        return graph;
    }

    GraphSlamSession session_;
    bool all_tracked_ = true;
};

TEST_F(SeenRoom, posesAreRightAndTheRoundIsClosedByALoop) {
    EXPECT_TRUE(all_tracked_);
    const auto frames = session_.slam().frames();
    ASSERT_EQ(frames.size(), film().size());
    const SE3 T_base_cam = T_optical_from_mrpt.inverse();
    const SE3 T_room_first = roundTrip(0, turn_rad) * T_base_cam;
    for (int i = 0; i < whole_film; ++i) {
        const SE3 truth = T_room_first.inverse() * roundTrip(i, turn_rad) * T_base_cam;
        EXPECT_LT((frames[i].T_world_cam.t - truth.t).norm(), 0.03) << i;
    }
    EXPECT_FALSE(session_.slam().loops().empty());
}

TEST_F(SeenRoom, graphHasANodeForEachKeyframeAndAllEdges) {
    const SE3 T_out_world(rotationExp({0.3, 0.2, 0.1}), Eigen::Vector3d(1, 2, 3));
    const auto graph = writtenGraph(T_out_world);
    const auto keyframes = session_.slam().keyframes();
    ASSERT_EQ(graph.nodes.size(), keyframes.size());
    EXPECT_EQ(graph.edges.size(), keyframes.size() - 1 + session_.slam().loops().size());
    for (const KeyframeView& keyframe : keyframes) {
        const SE3 expected = T_out_world * keyframe.T_world_cam * session_.T_base_cam().inverse();
        EXPECT_LT(toSE3(graph.nodes.at(keyframe.id)).minus(expected).norm(), 1e-4);
    }
}

TEST_F(SeenRoom, edgesAgreeWithTheNodesTheyTie) {
    const auto graph = writtenGraph(SE3());
    for (const auto& [ends, edge] : graph.edges) {
        const auto predicted = graph.nodes.at(ends.second) - graph.nodes.at(ends.first);
        EXPECT_LT(toSE3(predicted).minus(toSE3(edge.mean)).norm(), 0.05)
            << ends.first << " - " << ends.second;
    }
}

TEST(GraphSlamSession, oneKeyframeMakesAGraphOfOneNode) {
    GraphSlamSession session({}, *film().front());
    session.step(film().front());
    session.finish();
    const TestFolder folder;
    session.writeGraph(folder / "a.graph", SE3());
    mrpt::graphs::CNetworkOfPoses3DInf graph;
    graph.loadFromTextFile(folder / "a.graph");
    EXPECT_EQ(graph.nodes.size(), 1u);
}

TEST(GraphSlamSession, stampThatGoesBackIsRefusedInOneLine) {
    GraphSlamSession session({}, *film().front());
    session.step(film()[1]);
    try {
        session.step(film()[0]);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("not later"), std::string::npos);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
