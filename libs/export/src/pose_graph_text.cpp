#include "rgbd_graphslam/export/pose_graph_text.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

Eigen::Matrix3d rotationOf(double roll, double pitch, double yaw) {
    return rotationExp({0, 0, yaw}) * rotationExp({0, pitch, 0}) * rotationExp({roll, 0, 0});
}

/** Reads numbers from one line and complains of the line. */
class GraphLine {
  public:
    GraphLine(const std::string& line, const std::string& where) : in_(line), where_(where) {
        in_ >> key_;
    }

    const std::string& key() const { return key_; }

    int id() {
        int value = -1;
        if (!(in_ >> value) || value < 0) fail("needs a node number");
        return value;
    }

    template <std::size_t count>
    std::array<double, count> numbers() {
        std::array<double, count> values{};
        for (double& value : values) {
            if (!(in_ >> value) || !std::isfinite(value)) fail("has too few numbers");
        }
        return values;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(where_ + " " + what, "run rgbd-slam again");
    }

  private:
    std::istringstream in_;
    std::string where_, key_;
};

/** The upper triangle by rows. */
Matrix6d symmetric(const std::array<double, 21>& upper) {
    Matrix6d matrix;
    auto next = upper.begin();
    for (int row = 0; row < 6; ++row) {
        for (int column = row; column < 6; ++column) {
            matrix(row, column) = matrix(column, row) = *next++;
        }
    }
    return matrix;
}

void readVertex(GraphLine& line, PoseGraphText& graph) {
    PoseGraphNode node;
    node.id = line.id();
    const auto p = line.numbers<6>();
    node.pose = SE3(rotationOf(p[3], p[4], p[5]), {p[0], p[1], p[2]});
    graph.nodes.push_back(node);
}

void readEdge(GraphLine& line, PoseGraphText& graph) {
    PoseGraphEdge edge;
    edge.from = line.id();
    edge.to = line.id();
    const auto p = line.numbers<6>();
    edge.mean = SE3(rotationOf(p[3], p[4], p[5]), {p[0], p[1], p[2]});
    edge.information =
        quaternionInformation(symmetric(line.numbers<21>()), edge.mean.R, p[5], p[4]);
    if (!edge.information.allFinite())
        line.fail("has a pitch of 90 degrees, where its information is not defined");
    graph.edges.push_back(edge);
}

void readLine(GraphLine line, PoseGraphText& graph, std::set<int>& fixed) {
    if (line.key() == "VERTEX3") {
        readVertex(line, graph);
    } else if (line.key() == "EDGE3") {
        readEdge(line, graph);
    } else if (line.key() == "FIX") {
        fixed.insert(line.id());
    } else {
        line.fail("is neither VERTEX3, EDGE3 nor FIX");
    }
}

void checkEdges(const PoseGraphText& graph, const std::string& name) {
    std::set<int> ids;
    for (const PoseGraphNode& node : graph.nodes) {
        if (!ids.insert(node.id).second) {
            throw Error("'" + name + "' has node " + std::to_string(node.id) + " twice",
                        "run rgbd-slam again");
        }
    }
    if (ids.empty()) throw Error("'" + name + "' has no nodes", "run rgbd-slam again");
    for (const PoseGraphEdge& edge : graph.edges) {
        for (const int end : {edge.from, edge.to}) {
            if (ids.count(end)) continue;
            throw Error(
                "'" + name + "' has an edge to node " + std::to_string(end) + ", which is missing",
                "run rgbd-slam again");
        }
    }
}

std::string poseText(const SE3& pose) {
    const Eigen::Quaterniond q = pose.quaternion();
    return formatted("%.9g %.9g %.9g %.9g %.9g %.9g %.9g", pose.t.x(), pose.t.y(), pose.t.z(),
                     q.x(), q.y(), q.z(), q.w());
}

}  // namespace

Matrix6d quaternionInformation(const Matrix6d& parameter_information, const Eigen::Matrix3d& R,
                               double yaw, double pitch) {
    // Angular velocity in the frame of the mean's target for rates of roll, pitch and yaw.
    const Eigen::Matrix3d Rz = rotationExp({0, 0, yaw}), Ry = rotationExp({0, pitch, 0});
    Eigen::Matrix3d rates;
    rates << Rz * Ry.col(0), Rz.col(1), Eigen::Vector3d::UnitZ();
    // delta = (R^T dt, w / 2), hence dt = R delta_t and d(roll, pitch, yaw) = rates^-1 R 2 delta_q.
    Matrix6d parameters = Matrix6d::Zero();
    parameters.topLeftCorner<3, 3>() = R;
    parameters.bottomRightCorner<3, 3>() = 2 * rates.inverse() * R;
    return parameters.transpose() * parameter_information * parameters;
}

PoseGraphText parseMrptGraph(const std::string& text, const std::string& name) {
    PoseGraphText graph;
    std::set<int> fixed;
    std::istringstream in(text);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
        readLine({line, name + ":" + std::to_string(number)}, graph, fixed);
    }
    checkEdges(graph, name);
    for (PoseGraphNode& node : graph.nodes) node.fixed = fixed.count(node.id) > 0;
    return graph;
}

std::string toG2oText(const PoseGraphText& graph) {
    std::string text;
    for (const PoseGraphNode& node : graph.nodes) {
        text += "VERTEX_SE3:QUAT " + std::to_string(node.id) + " " + poseText(node.pose) + "\n";
        if (node.fixed) text += "FIX " + std::to_string(node.id) + "\n";
    }
    for (const PoseGraphEdge& edge : graph.edges) {
        text += "EDGE_SE3:QUAT " + std::to_string(edge.from) + " " + std::to_string(edge.to) + " " +
                poseText(edge.mean);
        for (int row = 0; row < 6; ++row) {
            for (int column = row; column < 6; ++column)
                text += formatted(" %.9g", edge.information(row, column));
        }
        text += "\n";
    }
    return text;
}

}  // namespace rgbd_graphslam
