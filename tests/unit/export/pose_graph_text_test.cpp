#include "rgbd_graphslam/export/pose_graph_text.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <sstream>

#include "../../support/problem_of.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;

Eigen::Matrix3d rotation(double roll, double pitch, double yaw) {
    return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

SE3 pose(const Vector6d& p) {
    return SE3(rotation(p[3], p[4], p[5]), p.head<3>());
}

/** The error that g2o's EdgeSE3 computes: translation and vector part of the quaternion. */
Vector6d g2oError(const SE3& mean, const SE3& measured) {
    const SE3 delta = mean.inverse() * measured;
    Eigen::Quaterniond q(delta.R);
    if (q.w() < 0) q.coeffs() *= -1;
    Vector6d error;
    error << delta.t, q.vec();
    return error;
}

struct Example {
    Vector6d mean;         // x y z roll pitch yaw
    Matrix6d information;  // of these
};

Example randomExample(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Example example;
    Matrix6d A;
    for (int i = 0; i < 6; ++i) {
        example.mean[i] = uniform(random);
        for (int j = 0; j < 6; ++j) A(i, j) = uniform(random);
    }
    example.information = 1e4 * (A * A.transpose() + Matrix6d::Identity());
    return example;
}

std::string edgeLine(const Example& example) {
    std::string line = "EDGE3 0 1";
    for (const double value : example.mean) line += formatted(" %.17g", value);
    for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) line += formatted(" %.17g", example.information(i, j));
    }
    return line + "\n";
}

const std::string two_nodes = "VERTEX3 0 0 0 1.5 0 0 0\nFIX 0\nVERTEX3 1 1 2 3 0.1 -0.2 0.3\n";

TEST(PoseGraphText, weighsErrorsAsTheGraphItComesFrom) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);
    for (int trial = 0; trial < 100; ++trial) {
        const Example example = randomExample(random);
        const PoseGraphText graph = parseMrptGraph(two_nodes + edgeLine(example), "test");
        ASSERT_EQ(graph.edges.size(), 1u);
        Vector6d step;
        for (double& value : step) value = uniform(random);
        const double expected = step.dot(example.information * step);
        const Vector6d error = g2oError(graph.edges[0].mean, pose(example.mean + step));
        EXPECT_NEAR(error.dot(graph.edges[0].information * error) / expected, 1, 2e-3);
    }
}

TEST(PoseGraphText, isReadBackFromG2oText) {
    std::mt19937 random(3);
    const Example example = randomExample(random);
    const PoseGraphText graph = parseMrptGraph(two_nodes + edgeLine(example), "test");
    std::istringstream in(toG2oText(graph));
    std::string key;
    int id = -1, to = -1;
    double v[7];
    ASSERT_TRUE(in >> key >> id);
    EXPECT_EQ(key, "VERTEX_SE3:QUAT");
    for (double& value : v) in >> value;
    EXPECT_EQ(v[2], 1.5);
    EXPECT_EQ(v[6], 1);
    ASSERT_TRUE(in >> key >> id);
    EXPECT_EQ(key + std::to_string(id), "FIX0");
    ASSERT_TRUE(in >> key >> id);
    EXPECT_EQ(key + std::to_string(id), "VERTEX_SE3:QUAT1");
    for (double& value : v) in >> value;
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    EXPECT_LT((q.toRotationMatrix() - rotation(0.1, -0.2, 0.3)).norm(), 1e-8);
    ASSERT_TRUE(in >> key >> id >> to);
    EXPECT_EQ(key, "EDGE_SE3:QUAT");
    for (double& value : v) in >> value;
    EXPECT_NEAR(v[0], example.mean[0], 1e-8);
    for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) {
            double value = 0;
            ASSERT_TRUE(in >> value);
            EXPECT_NEAR(value / graph.edges[0].information(i, j), 1, 1e-7);
        }
    }
    EXPECT_FALSE(in >> key);
}

TEST(PoseGraphText, namesTheLineThatIsWrong) {
    const auto problem = [](const std::string& text) {
        return problemOf([&] { parseMrptGraph(text, "graph.graph"); });
    };
    EXPECT_THAT(problem(two_nodes + "EDGE3 0 1 1 2\n"), HasSubstr("graph.graph:4 has too few"));
    EXPECT_THAT(problem("VERTEX3 0 0 0 nan 0 0 0\n"), HasSubstr("graph.graph:1"));
    EXPECT_THAT(problem("VERTEX3 -1 0 0 0 0 0 0\n"), HasSubstr("graph.graph:1 needs"));
    EXPECT_THAT(problem("VERTEX2 0 0 0 0\n"), HasSubstr("graph.graph:1 is neither"));
    EXPECT_THAT(problem(two_nodes + two_nodes), HasSubstr("twice"));
    EXPECT_THAT(problem(""), HasSubstr("no nodes"));
    std::mt19937 random(1);
    std::string edge = edgeLine(randomExample(random));
    edge.replace(edge.find("0 1"), 3, "0 7");
    EXPECT_THAT(problem(two_nodes + edge), HasSubstr("node 7, which is missing"));
}

}  // namespace
}  // namespace rgbd_graphslam
