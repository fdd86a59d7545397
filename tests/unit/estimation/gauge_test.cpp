/** What is estimated does not depend on the frame it is written in, nor on the order of things. */
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "bundle.h"
#include "rgbd_graphslam/estimation/bundle_adjustment.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/estimation/pose_graph.h"

namespace rgbd_graphslam {
namespace {

/** Rounds on a circle with noisy odometry, loops from round to round, one of them wrong. */
PoseGraph someGraph(unsigned seed) {
    RandomInputs random(seed);
    constexpr int nodes = 60, per_round = 20;
    std::vector<SE3> truth;
    for (int i = 0; i < nodes; ++i) {
        const double turn = 2 * M_PI * i / per_round;
        truth.emplace_back(rotationExp({0.1 * std::sin(turn), 0, turn}),
                           Eigen::Vector3d(3 * std::cos(turn), 3 * std::sin(turn), 0.01 * i));
    }
    PoseGraph graph;
    const auto connect = [&](int from, int to, EdgeKind kind, double noise) {
        Vector6d weights;
        for (int k = 0; k < 6; ++k) weights[k] = random.uniform(1e3, 1e5);
        const SE3 measured =
            (truth[from].inverse() * truth[to]) * SE3().retract(random.tangent(noise, noise));
        graph.edges.push_back({from, to, measured, weights.asDiagonal(), kind, 50});
    };
    graph.nodes.push_back(truth[0]);
    for (int i = 1; i < nodes; ++i) {
        connect(i - 1, i, EdgeKind::Sequential, 0.02);
        graph.nodes.push_back(graph.nodes.back() * graph.edges.back().T_from_to);
    }
    for (int i = 0; i + per_round < nodes; i += 5) connect(i, i + per_round, EdgeKind::Loop, 0.02);
    connect(3, 47, EdgeKind::Loop, 1.0);
    return graph;
}

/** So that two ways to the minimum end at the same numbers. */
PoseGraph optimized(PoseGraph graph, int fixed = 0) {
    for (int round = 0; round < 20; ++round) optimizePoseGraph(graph, {}, fixed);
    return graph;
}

double largestDifference(const std::vector<SE3>& a, const std::vector<SE3>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, a[i].minus(b[i]).norm());
    }
    return largest;
}

/** The solvers stop when the cost falls by less than a hundred-thousandth; m, rad. Noise moves
 *  nodes by centimeters. */
constexpr double same = 5e-4;

TEST(Gauge, aPoseGraphInAnotherFrameGivesTheSameGraphThere) {
    RandomInputs random(1);
    for (unsigned seed = 0; seed < 5; ++seed) {
        const PoseGraph start = someGraph(seed), expected = optimized(start);
        ASSERT_GT(largestDifference(start.nodes, expected.nodes), 100 * same);
        const SE3 motion = random.pose();
        PoseGraph moved = start;
        for (SE3& node : moved.nodes) node = motion * node;
        moved = optimized(moved);
        for (SE3& node : moved.nodes) node = motion.inverse() * node;
        EXPECT_LT(largestDifference(moved.nodes, expected.nodes), same) << seed;
    }
}

TEST(Gauge, aPoseGraphInAnotherOrderGivesTheSameGraph) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const PoseGraph start = someGraph(seed), expected = optimized(start);
        RandomInputs random(100 + seed);
        std::vector<int> place(start.nodes.size());
        std::iota(place.begin(), place.end(), 0);
        for (std::size_t i = place.size() - 1; i > 0; --i) {
            std::swap(place[i], place[random.index(static_cast<int>(i) + 1)]);
        }
        PoseGraph shuffled = start;
        for (std::size_t i = 0; i < place.size(); ++i) shuffled.nodes[place[i]] = start.nodes[i];
        for (PoseEdge& edge : shuffled.edges)
            edge.from = place[edge.from], edge.to = place[edge.to];
        std::reverse(shuffled.edges.begin(), shuffled.edges.end());
        shuffled = optimized(shuffled, place[0]);
        std::vector<SE3> back;
        for (const int p : place) back.push_back(shuffled.nodes[p]);
        EXPECT_LT(largestDifference(back, expected.nodes), same) << seed;
    }
}

template <class Adjust>
void expectSameInAnyFrame(Adjust adjust) {
    RandomInputs random(3);
    for (unsigned seed = 0; seed < 4; ++seed) {
        BundleProblem here = someBundle(seed, 1, 0).problem, there = here;
        const SE3 motion = random.pose();
        for (auto& k : there.states.keyframes) k.T_body_world = k.T_body_world * motion.inverse();
        for (Eigen::Vector3d& point : there.states.points) point = motion * point;
        ASSERT_NEAR(bundleCost(here), bundleCost(there), 1e-9 * bundleCost(here));
        const double before = bundleCost(here);
        adjust(here);
        adjust(there);
        EXPECT_LT(bundleCost(here), 0.5 * before);
        for (auto& k : there.states.keyframes) k.T_body_world = k.T_body_world * motion;
        EXPECT_LT(largestDifference(here.states, there.states), same) << seed;
        for (std::size_t p = 0; p < here.states.points.size(); ++p) {
            EXPECT_LT((motion * here.states.points[p] - there.states.points[p]).norm(), same) << p;
        }
    }
}

TEST(Gauge, bundleAdjustmentInAnotherFrameGivesTheSameThere) {
    expectSameInAnyFrame([](BundleProblem& problem) { adjustBundle(problem, 100, false); });
}

TEST(Gauge, sparseBundleAdjustmentInAnotherFrameGivesTheSameThere) {
    expectSameInAnyFrame([](BundleProblem& problem) { adjustBundleSparse(problem, 100, false); });
}

TEST(Gauge, noStepFromTheMinimumOfABundleLowersItsCost) {
    RandomInputs random(4);
    BundleProblem best = someBundle(9, 1, 0).problem;
    adjustBundle(best, 200, false);
    const double least = bundleCost(best);
    for (int trial = 0; trial < 300; ++trial) {
        BundleProblem other = best;
        const double step = std::pow(10, random.uniform(-4, -1));
        KeyframeState& state = other.states.keyframes[random.index(best.free_keyframes)];
        state = state.retract(random.tangent(step, step));
        auto& points = other.states.points;
        points[random.index(static_cast<int>(points.size()))] += random.vector(step);
        EXPECT_GE(bundleCost(other), least * (1 - 1e-9));
    }
}

}  // namespace
}  // namespace rgbd_graphslam
