#include "rgbd_graphslam/graphslam/options_checker.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <memory>
#include <mutex>

#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {

class NamedDeciders : public testing::Test {
  protected:
    void SetUp() override {
        checker_.createDeciderOptimizerMappings();
        checker_.populateDeciderOptimizerProperties();
        nodes_.reset(checker_.node_regs_map.at("COrbKeyframeNRD")());
        edges_.reset(checker_.edge_regs_map.at("COrbLoopClosureERD")());
        optimizer_.reset(checker_.optimizers_map.at("CCeresGSO")());
        nodes_->setGraphPtr(&graph_);
        edges_->setGraphPtr(&graph_);
        optimizer_->setGraphPtr(&graph_);
    }

    KeyframeGraph graph_;
    KeyframeOptionsChecker checker_;
    std::unique_ptr<mrpt::graphslam::deciders::CNodeRegistrationDecider<KeyframeGraph>> nodes_;
    std::unique_ptr<mrpt::graphslam::deciders::CEdgeRegistrationDecider<KeyframeGraph>> edges_;
    std::unique_ptr<mrpt::graphslam::optimizers::CGraphSlamOptimizer<KeyframeGraph>> optimizer_;
};

TEST_F(NamedDeciders, areKnownToMrptsApplications) {
    EXPECT_TRUE(checker_.checkRegistrationDeciderExists("COrbKeyframeNRD", "node"));
    EXPECT_TRUE(checker_.checkRegistrationDeciderExists("COrbLoopClosureERD", "edge"));
    EXPECT_TRUE(checker_.checkOptimizerExists("CCeresGSO"));
    EXPECT_FALSE(checker_.checkRegistrationDeciderExists("COrbKeyframeNRD", "edge"));
}

TEST_F(NamedDeciders, readTheirSectionsOfAnIniWithOthers) {
    const TestFolder folder;
    folder.write(
        "a.ini",
        "[GeneralConfiguration]\nclass_verbosity = 1\n[TrackerOptions]\nmin_inliers = 33\n");
    nodes_->loadParams(folder / "a.ini");
    EXPECT_EQ(graph_.shared->options.tracker.min_inliers, 33);
}

TEST_F(NamedDeciders, buildAGraphFromObservationsAlone) {
    std::size_t registrations = 0;
    for (const auto& frame : filmRoundTrip(20, 0.08)) {
        registrations += nodes_->updateState(nullptr, nullptr, frame);
        edges_->updateState(nullptr, nullptr, frame);
        optimizer_->updateState(nullptr, nullptr, frame);
    }
    EXPECT_GT(registrations, 2u);
    EXPECT_EQ(graph_.nodeCount(), registrations + 1);
    EXPECT_EQ(graph_.edgeCount(), registrations);
}

TEST_F(NamedDeciders, ignoreOtherSensors) {
    const auto other = mrpt::obs::CObservation2DRangeScan::Create();
    EXPECT_FALSE(nodes_->updateState(nullptr, nullptr, other));
    edges_->updateState(nullptr, nullptr, other);
    optimizer_->updateState(nullptr, nullptr, other);
    EXPECT_EQ(graph_.nodeCount(), 0u);
}

}  // namespace
}  // namespace rgbd_graphslam
