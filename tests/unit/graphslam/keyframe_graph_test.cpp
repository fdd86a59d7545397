#include "rgbd_graphslam/graphslam/keyframe_graph.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/estimation/relative_pose.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_base_cam(rotationExp({0.1, 0.4, -0.2}) * T_optical_from_mrpt.R.transpose(),
                     Eigen::Vector3d(0.3, -0.1, 0.8));

PoseEdge someEdge() {
    PoseEdge edge;
    edge.T_from_to = SE3(rotationExp({0.2, -0.5, 0.3}), Eigen::Vector3d(0.4, 0.1, -0.7));
    Matrix6d root;
    for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = std::sin(1.7 * i + 0.3);
    edge.information = root * root.transpose() + 5 * Matrix6d::Identity();
    return edge;
}

TEST(KeyframeGraph, robotEdgeSaysTheSameAsTheCameraEdge) {
    const PoseEdge edge = someEdge();
    const auto robot = robotEdge(edge, T_base_cam);
    const SE3 mean = toSE3(robot.mean);
    EXPECT_LT(mean.minus(T_base_cam * edge.T_from_to * T_base_cam.inverse()).norm(), 1e-9);

    const double h = 1e-5;
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            const auto residual = [&](int axis) {
                mrpt::math::CVectorFixedDouble<6> x = robot.mean.asVectorVal();
                x[axis] += h;
                const mrpt::poses::CPose3D moved(x[0], x[1], x[2], x[3], x[4], x[5]);
                const SE3 camera = T_base_cam.inverse() * toSE3(moved) * T_base_cam;
                return Vector6d(relativePoseError(camera, edge.T_from_to) / h);
            };
            const double expected = residual(i).dot(edge.information * residual(j));
            EXPECT_NEAR(robot.cov_inv(i, j), expected, 2e-3 * edge.information.norm());
        }
    }
}

TEST(KeyframeGraph, firstRobotPoseIsTheOrigin) {
    EXPECT_LT(toSE3(robotPose(SE3(), T_base_cam)).minus(SE3()).norm(), 1e-12);
}

TEST(KeyframeGraph, losesTheEdgesOfLoopsThatTheSlamDropped) {
    KeyframeGraph graph;
    graph.shared->slam = std::make_unique<VisualSlam>(SlamOptions{}, CameraModel{});
    PoseEdge edge = someEdge();
    const auto insert = [&](int from, int to, EdgeKind kind) {
        edge.from = from;
        edge.to = to;
        edge.kind = kind;
        graph.insertEdge(from, to, registered(edge, *graph.shared));
    };
    for (int i = 0; i < 5; ++i) insert(i, i + 1, EdgeKind::Sequential);
    insert(0, 4, EdgeKind::Loop);
    dropForgottenLoops(graph);
    EXPECT_EQ(graph.edges.size(), 5u);
    EXPECT_EQ(graph.edges.count({0, 4}), 0u);
}

}  // namespace
}  // namespace rgbd_graphslam
