#include "../../../libs/slam/src/keyframe_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

class KeyframeEdgesTest : public testing::Test {
  protected:
    void add(int keyframes) {
        for (int k = 0; k < keyframes; ++k) exact_.add(k);
    }
    std::vector<PoseEdge> edgesTo(int keyframe) const {
        std::vector<PoseEdge> edges = edges_.graph({}).edges;
        edges.erase(std::remove_if(edges.begin(), edges.end(),
                                   [&](const PoseEdge& e) { return e.to != keyframe; }),
                    edges.end());
        return edges;
    }

    const SensorOptions sensor_;
    ExactMap exact_;
    const KeyframeEdges edges_{sensor_, exact_.cameras, exact_.map};
};

TEST_F(KeyframeEdgesTest, measureTheMotionBetweenKeyframes) {
    add(2);
    const auto edges = edgesTo(1);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_EQ(edges[0].kind, EdgeKind::Sequential);
    const SE3 truth = ExactMap::truth(0) * ExactMap::truth(1).inverse();
    EXPECT_LT(edges[0].T_from_to.minus(truth).norm(), 1e-12);
    EXPECT_EQ(edges[0].information, edges_.odometry(1).information);
}

TEST_F(KeyframeEdgesTest, tieAKeyframeToAllThatSeeTheSame) {
    add(6);
    const auto edges = edgesTo(5);
    ASSERT_EQ(edges.size(), 5u);
    for (std::size_t i = 1; i < edges.size(); ++i) {
        EXPECT_EQ(edges[i].kind, EdgeKind::Covisibility);
        const SE3 truth = ExactMap::truth(edges[i].from) * ExactMap::truth(5).inverse();
        EXPECT_LT(edges[i].T_from_to.minus(truth).norm(), 1e-12);
    }
}

TEST_F(KeyframeEdgesTest, shareTheEvidence) {
    add(6);
    const Matrix6d measured = edges_.odometry(5).information;
    for (const PoseEdge& edge : edgesTo(5)) {
        EXPECT_LT((edge.information - 3.0 / 25 * measured).norm(), 1e-9 * measured.norm());
    }
}

}  // namespace
}  // namespace rgbd_graphslam
