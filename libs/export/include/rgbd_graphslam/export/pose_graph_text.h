/** Pose graphs as text: MRPT's in, g2o's out. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A pose of the graph. */
struct PoseGraphNode {
    int id = 0;
    SE3 pose;
    bool fixed = false;
};

/** A relative pose with its information. */
struct PoseGraphEdge {
    int from = 0, to = 0;
    SE3 mean;  // T_from_to
    /** Of delta = mean^-1 * T_from_to, as (translation, vector part of the unit quaternion): the
     *  error that g2o's EdgeSE3 weighs (Kuemmerle et al., "g2o: A general framework for graph
     *  optimization", ICRA 2011). */
    Matrix6d information;
};

/** A whole graph as read from text. */
struct PoseGraphText {
    std::vector<PoseGraphNode> nodes;
    std::vector<PoseGraphEdge> edges;
};

/** Information of (translation, quaternion's vector part) of mean^-1 * T for one of the parameters
 *  (x, y, z, roll, pitch, yaw) of T, to first order around the mean.
 *  \param yaw,pitch of the mean, rad; R = Rz(yaw) Ry(pitch) Rx(roll) */
Matrix6d quaternionInformation(const Matrix6d& parameter_information, const Eigen::Matrix3d& R,
                               double yaw, double pitch);

/** Reads the text that MRPT's CNetworkOfPoses writes for 3-D graphs with information matrices:
 *  VERTEX3, EDGE3 and FIX lines.
 *  \param name stands for the file in error messages
 *  \throws Error naming the line that is something else, has too few numbers or numbers that are
 *          not finite; an edge between nodes that are not there; no node at all */
PoseGraphText parseMrptGraph(const std::string& text, const std::string& name);

/** VERTEX_SE3:QUAT, FIX and EDGE_SE3:QUAT lines. */
std::string toG2oText(const PoseGraphText& graph);

}  // namespace rgbd_graphslam
