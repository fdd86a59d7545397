#include "rgbd_graphslam/estimation/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double pi = 3.14159265358979323846;

/** Gaussian numbers that are the same with every standard library. */
class Noise {
  public:
    explicit Noise(unsigned seed) : generator_(seed) {}
    double uniform() { return (generator_() + 0.5) / 4294967296.0; }
    double gaussian() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * pi * uniform()); }
    Vector6d tangent(double sigma_m, double sigma_rad) {
        Vector6d delta;
        for (int i = 0; i < 6; ++i) delta[i] = gaussian() * (i < 3 ? sigma_m : sigma_rad);
        return delta;
    }
    int index(int count) { return static_cast<int>(uniform() * count); }

  private:
    std::mt19937 generator_;
};

constexpr double sigma_m = 0.01, sigma_rad = 0.003;

Matrix6d information() {
    Vector6d diagonal;
    diagonal << Eigen::Vector3d::Constant(1 / (sigma_m * sigma_m)),
        Eigen::Vector3d::Constant(1 / (sigma_rad * sigma_rad));
    return diagonal.asDiagonal();
}

/** Rounds on a wavy circle of 8 x 5 m, and what odometry and loops measure of them. */
struct World {
    World(int nodes, int rounds, unsigned seed) : noise(seed), per_round(nodes / rounds) {
        for (int i = 0; i < nodes; ++i) {
            const double a = 2 * pi * i / per_round;
            const Eigen::Vector3d tilt(0.2 * std::sin(3 * a), 0.1 * std::cos(2 * a), 0);
            truth.emplace_back(
                rotationExp({0, 0, a}) * rotationExp(tilt),
                Eigen::Vector3d(8 * std::cos(a), 5 * std::sin(a), 0.3 * std::sin(a)));
        }
        graph.nodes.push_back(truth[0]);
        for (int i = 1; i < nodes; ++i) {
            addEdge(i - 1, i, EdgeKind::Sequential);
            graph.nodes.push_back(graph.nodes.back() * graph.edges.back().T_from_to);
        }
    }
    void addEdge(int from, int to, EdgeKind kind) {
        const SE3 measured =
            (truth[from].inverse() * truth[to]) * SE3().retract(noise.tangent(sigma_m, sigma_rad));
        graph.edges.push_back({from, to, measured, information(), kind, 50});
    }
    void addLoops(int count) {
        for (int i = 0; i < count; ++i) {
            const int from = noise.index(static_cast<int>(truth.size()) - per_round);
            addEdge(from, from + per_round, EdgeKind::Loop);
        }
    }
    void addWrongLoops(int count) {
        const int nodes = static_cast<int>(truth.size());
        for (int i = 0; i < count; ++i) {
            const int from = noise.index(nodes), to = (from + 20 + noise.index(nodes - 40)) % nodes;
            const SE3 near = SE3().retract(noise.tangent(0.3, 0.3));
            graph.edges.push_back({from, to, near, information(), EdgeKind::Loop, 50});
        }
    }
    double rmse() const {
        double sum = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            sum += (truth[i].t - graph.nodes[i].t).squaredNorm();
        }
        return std::sqrt(sum / truth.size());
    }

    Noise noise;
    int per_round;
    std::vector<SE3> truth;
    PoseGraph graph;
};

TEST(PoseGraph, exactMeasurementsAreMetFromAnyStart) {
    World world(40, 2, 2);
    for (PoseEdge& edge : world.graph.edges) {
        edge.T_from_to = world.truth[edge.from].inverse() * world.truth[edge.to];
    }
    for (std::size_t i = 1; i < world.graph.nodes.size(); ++i) {
        world.graph.nodes[i] = world.graph.nodes[i].retract(world.noise.tangent(0.3, 0.3));
    }
    const PoseGraphSummary summary = optimizePoseGraph(world.graph, {});
    EXPECT_TRUE(summary.converged);
    EXPECT_LT(summary.final_cost, 1e-6 * summary.initial_cost);
    EXPECT_LT(world.rmse(), 1e-4);
}

TEST(PoseGraph, tenPercentWrongLoopsAreSurvived) {
    World clean(400, 4, 3);
    clean.addLoops(100);
    World spoilt = clean;
    spoilt.addWrongLoops(10);
    const double before = clean.rmse();
    optimizePoseGraph(clean.graph, {});
    optimizePoseGraph(spoilt.graph, {});
    EXPECT_LT(clean.rmse(), 0.5 * before);
    EXPECT_LT(spoilt.rmse(), clean.rmse() + 0.02);
}

TEST(PoseGraph, oneTrueLoopPullsInALongDrift) {
    World world(800, 1, 4);
    world.addEdge(0, 799, EdgeKind::Loop);
    const auto gap = [&] { return (world.graph.nodes[799].t - world.truth[799].t).norm(); };
    ASSERT_GT(gap(), 20 * sigma_m);
    optimizePoseGraph(world.graph, {});
    EXPECT_LT(gap(), 4 * sigma_m);
}

TEST(PoseGraph, fixedNodeStaysAndTheRestFollows) {
    World world(60, 2, 5);
    world.addLoops(10);
    const SE3 fixed = world.graph.nodes[59];
    const SE3 first = world.graph.nodes[0];
    optimizePoseGraph(world.graph, {}, 59);
    EXPECT_EQ(world.graph.nodes[59].R, fixed.R);
    EXPECT_EQ(world.graph.nodes[59].t, fixed.t);
    EXPECT_GT((world.graph.nodes[0].t - first.t).norm(), 1e-6);
}

TEST(PoseGraph, heldNodesStayAndTheRestFollows) {
    World world(60, 2, 11);
    for (int i = 0; i < 30; ++i) {
        world.graph.nodes[i] = world.truth[i];
        world.addEdge(i, i + 30, EdgeKind::Loop);
    }
    world.graph.fixed = 30;
    optimizePoseGraph(world.graph, PoseGraphOptions());
    for (int i = 0; i < 60; ++i) {
        const double error = (world.graph.nodes[i].t - world.truth[i].t).norm();
        EXPECT_LE(error, i < 30 ? 0 : 5 * sigma_m) << i;
    }
}

TEST(PoseGraph, resultIsTheSameEachTime) {
    World a(200, 4, 6);
    a.addLoops(50);
    a.addWrongLoops(5);
    World b = a;
    optimizePoseGraph(a.graph, {});
    optimizePoseGraph(b.graph, {});
    for (std::size_t i = 0; i < a.truth.size(); ++i)
        EXPECT_EQ(a.graph.nodes[i].t, b.graph.nodes[i].t);
}

TEST(PoseGraph, badEdgesAreNamed) {
    World world(10, 1, 7);
    PoseGraph graph = world.graph;
    graph.edges[3].to = 10;
    EXPECT_THROW(optimizePoseGraph(graph, {}), Error);
    graph = world.graph;
    graph.edges[3].information(2, 2) = -1;
    EXPECT_THROW(optimizePoseGraph(graph, {}), Error);
    graph.edges[3].information(2, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(optimizePoseGraph(graph, {}), Error);
    EXPECT_THROW(optimizePoseGraph(world.graph, {}, 10), Error);
    PoseGraph empty;
    EXPECT_THROW(optimizePoseGraph(empty, {}), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
