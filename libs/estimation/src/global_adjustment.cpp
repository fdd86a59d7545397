#include "rgbd_graphslam/estimation/global_adjustment.h"

#include <ceres/solver.h>

#include "factor_problem.h"
#include "rgbd_graphslam/estimation/point_observation.h"

namespace rgbd_graphslam {
namespace {

/** Ceres gives up on a problem that cannot be evaluated at its start. */
bool canStart(const BundleObservation& o, const BundleProblem& problem) {
    const auto& [keyframes, points] = problem.states;
    return !o.outlier && !PointView(problem.cameras[o.camera], keyframes[o.keyframe].T_body_world,
                                    points[o.point])
                              .tooNear();
}

std::vector<PointObservation> pointObservations(const BundleProblem& problem) {
    std::vector<PointObservation> factors;
    factors.reserve(problem.observations.size());
    for (const BundleObservation& o : problem.observations) {
        if (!canStart(o, problem)) continue;
        factors.emplace_back(problem.cameras[o.camera], o.keyframe, o.point, o.measurement);
    }
    return factors;
}

BundleSummary minimize(BundleProblem& problem, int iterations) {
    const auto observations = pointObservations(problem);
    FactorProblem factors(problem.states);
    for (const PointObservation& o : observations) factors.add(o);
    for (const auto& factor : problem.factors) factors.add(*factor);
    const int keyframes = static_cast<int>(problem.states.keyframes.size());
    for (int k = problem.free_keyframes; k < keyframes; ++k) factors.hold(k);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.linear_solver_ordering = factors.pointsFirst();
    options.max_num_iterations = iterations;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &factors.problem(), &summary);
    for (int k = 0; k < problem.free_keyframes; ++k) {
        problem.states.keyframes[k] = factors.keyframe(k);
    }
    problem.states.points = factors.points();
    return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size())};
}

}  // namespace

BundleSummary adjustBundleSparse(BundleProblem& problem, int max_iterations, bool mark_outliers) {
    if (!mark_outliers) return minimize(problem, max_iterations);
    const BundleSummary first = minimize(problem, (max_iterations + 1) / 2);
    markBundleOutliers(problem);
    BundleSummary second = minimize(problem, (max_iterations + 1) / 2);
    second.initial_cost = first.initial_cost;
    second.iterations += first.iterations;
    return second;
}

}  // namespace rgbd_graphslam
