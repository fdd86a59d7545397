#include "rgbd_graphslam/estimation/pose_graph.h"

#include <ceres/solver.h>

#include <algorithm>
#include <string>

#include "factor_problem.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/estimation/relative_pose.h"

namespace rgbd_graphslam {
namespace {

void checkEnds(const PoseEdge& edge, int nodes) {
    if (std::min(edge.from, edge.to) >= 0 && std::max(edge.from, edge.to) < nodes &&
        edge.from != edge.to) {
        return;
    }
    throw Error("edge " + std::to_string(edge.from) + " - " + std::to_string(edge.to) +
                    " of a pose graph of " + std::to_string(nodes) + " nodes",
                "give it two nodes of the graph");
}

void checkFixed(int fixed, int nodes) {
    if (fixed >= 0 && fixed < nodes) return;
    throw Error("node " + std::to_string(fixed) + " of a pose graph of " + std::to_string(nodes) +
                    " nodes cannot be held fixed",
                "name a node of the graph");
}

RelativePose factorOf(const PoseEdge& edge, const PoseGraphOptions& options) {
    RobustKernel kernel;
    if (edge.kind == EdgeKind::Loop) {
        kernel = {KernelShape::Cauchy, options.loop_kernel_sigmas * options.loop_kernel_sigmas};
    }
    return RelativePose(edge.from, edge.to, edge.T_from_to, edge.information, kernel);
}

std::vector<RelativePose> factorsOf(const PoseGraph& graph, const PoseGraphOptions& options) {
    std::vector<RelativePose> factors;
    factors.reserve(graph.edges.size());
    for (const PoseEdge& edge : graph.edges) {
        checkEnds(edge, static_cast<int>(graph.nodes.size()));
        factors.push_back(factorOf(edge, options));
    }
    return factors;
}

States statesOf(const PoseGraph& graph) {
    States states;
    for (const SE3& T_world_cam : graph.nodes)
        states.keyframes.push_back({T_world_cam.inverse(), {}});
    return states;
}

ceres::Solver::Options solverOptions(const PoseGraphOptions& options) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options.max_iterations;
    solver.function_tolerance = 1e-5;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    return solver;
}

}  // namespace

void PoseGraphOptions::describe(OptionVisitor& v) {
    v.integer("max_iterations", max_iterations, 1, 1000, "",
              "Maximum Levenberg-Marquardt iterations");
    v.real("loop_kernel_sigmas", loop_kernel_sigmas, 0.1, 1000, "sigmas",
           "Residual at which a loop edge loses half its weight (Cauchy kernel)");
}

PoseGraphSummary optimizePoseGraph(PoseGraph& graph, const PoseGraphOptions& options, int fixed) {
    const int nodes = static_cast<int>(graph.nodes.size());
    checkFixed(fixed, nodes);
    const std::vector<RelativePose> factors = factorsOf(graph, options);
    FactorProblem problem(statesOf(graph));
    for (const RelativePose& factor : factors) problem.add(factor);
    problem.hold(fixed);
    for (int node = 0; node < graph.fixed; ++node) problem.hold(node);
    ceres::Solver::Summary summary;
    ceres::Solve(solverOptions(options), &problem.problem(), &summary);
    for (int node = graph.fixed; node < nodes; ++node) {
        if (node != fixed) graph.nodes[node] = problem.keyframe(node).T_body_world.inverse();
    }
    return {summary.initial_cost, summary.final_cost,
            static_cast<int>(summary.iterations.size()) - 1,
            summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace rgbd_graphslam
