/** Makes our deciders known by name to MRPT's graph-SLAM applications. */
#pragma once
#include <mrpt/config/CConfigFile.h>
#include <mrpt/graphslam/interfaces/CNodeRegistrationDecider.h>

// MRPT 2.5's header leans on the two above.
#include <mrpt/graphslam/apps_related/TUserOptionsChecker.h>

#include "rgbd_graphslam/graphslam/keyframe_graph.h"

namespace rgbd_graphslam {

/** MRPT's own choice and ours: COrbKeyframeNRD, COrbLoopClosureERD, CCeresGSO. For
 *  mrpt::graphslam::apps::CGraphSlamHandler<KeyframeGraph>. */
struct KeyframeOptionsChecker : mrpt::graphslam::apps::TUserOptionsChecker<KeyframeGraph> {
    void createDeciderOptimizerMappings() override;
    void populateDeciderOptimizerProperties() override;
};

}  // namespace rgbd_graphslam
