#include "rgbd_graphslam/graphslam/options_checker.h"

#include "rgbd_graphslam/graphslam/deciders.h"

namespace rgbd_graphslam {
using mrpt::graphslam::apps::TOptimizerProps;
using mrpt::graphslam::apps::TRegistrationDeciderProps;
namespace {

template <class Properties>
Properties* properties(const char* name, const char* description) {
    auto* result = new Properties;  // the base class deletes it
    result->name = name;
    result->description = description;
    result->is_slam_2d = false;
    result->is_slam_3d = true;
    return result;
}

TRegistrationDeciderProps* decider(const char* type, const char* name, const char* description) {
    auto* result = properties<TRegistrationDeciderProps>(name, description);
    result->type = type;
    result->rawlog_format = "#2 - Observation-only";
    result->observations_used.emplace_back("CObservation3DRangeScan - Format #2");
    return result;
}

}  // namespace

void KeyframeOptionsChecker::createDeciderOptimizerMappings() {
    TUserOptionsChecker::createDeciderOptimizerMappings();
    node_regs_map["COrbKeyframeNRD"] = &createNodeRegistrationDecider<COrbKeyframeNRD>;
    edge_regs_map["COrbLoopClosureERD"] = &createEdgeRegistrationDecider<COrbLoopClosureERD>;
    optimizers_map["CCeresGSO"] = &createGraphSlamOptimizer<CCeresGSO>;
}

void KeyframeOptionsChecker::populateDeciderOptimizerProperties() {
    TUserOptionsChecker::populateDeciderOptimizerProperties();
    regs_descriptions.push_back(decider(
        "Node", "COrbKeyframeNRD",
        "Track ORB features with depth; register a node where the view has changed enough"));
    regs_descriptions.push_back(
        decider("Edge", "COrbLoopClosureERD",
                "Recognize places by ORB descriptors, verify them geometrically, add loop edges"));
    optimizers_descriptions.push_back(properties<TOptimizerProps>(
        "CCeresGSO", "Ceres with a robust kernel on loop edges; needs COrbKeyframeNRD"));
}

}  // namespace rgbd_graphslam
