/** Loops that never were, asserted with the confidence of true ones, on a whole storey. */
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../support/synthetic_film.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {
namespace {

constexpr int keyframes_between = 10, least_gap = 30;

/** Says that a keyframe stands within half a meter of one that it has never been near to in time.
 */
PoseEdge falseLoop(const VisualSlam& slam, int keyframe) {
    PoseEdge loop = slam.odometryEdge(keyframe);  // as sure as tracking is
    loop.kind = EdgeKind::Loop;
    loop.from = keyframe * 7919 % (keyframe - least_gap + 1);
    loop.T_from_to = SE3(rotationExp({0, 0.05 * (keyframe % 7), 0}),
                         {0.1 * (keyframe % 5), 0, 0.05 * (keyframe % 3)});
    return loop;
}

class LoopInjector {
  public:
    LoopInjector(const CameraModel& camera, bool lies) : slam_(options(), camera), lies_(lies) {}

    void step(const RgbdImage& image) {
        const TrackedFrame tracked = slam_.track(slam_.prepare(image));
        if (!tracked.keyframe) return;
        const int keyframe = *tracked.keyframe;
        const bool due = keyframe > least_gap && keyframe % keyframes_between == 0;
        if (due && lies_) false_.push_back(falseLoop(slam_, keyframe));
        // Without lies the graph is optimized as often: correcting the map changes what follows.
        if (slam_.findLoops(keyframe).empty() && !due) return;
        PoseGraph graph = slam_.poseGraph();
        graph.edges.insert(graph.edges.end(), false_.begin(), false_.end());
        optimizePoseGraph(graph, PoseGraphOptions());
        slam_.correct(graph.nodes);
    }

    std::size_t falseLoops() const { return false_.size(); }

    Trajectory finish() {
        slam_.finish();
        Trajectory trajectory;
        for (const TrackedFrame& frame : slam_.frames()) {
            trajectory.push_back({frame.stamp_s, frame.T_world_cam});
        }
        return trajectory;
    }

  private:
    /** Adjusting everything after each of the false loops would take minutes. */
    static SlamOptions options() {
        SlamOptions options;
        options.mapper.loop_adjustment = false;
        return options;
    }

    VisualSlam slam_;
    const bool lies_;
    std::vector<PoseEdge> false_;
};

class FalseLoops : public testing::Test {
  protected:
    /** \return ATE RMSE, m */
    double run(bool lies) {
        RawlogReader reader(folder_ + ".rawlog");
        std::unique_ptr<LoopInjector> injector;
        while (const auto entry = reader.next()) {
            const auto frame = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(entry);
            if (!frame) continue;
            if (!injector) injector = std::make_unique<LoopInjector>(cameraOf(*frame), lies);
            injector->step(toRgbdImage(frame));
        }
        false_loops_ = injector->falseLoops();
        return evaluateAte(injector->finish(), readTumTrajectory(folder_ + "/groundtruth.txt"))
            .translation_m.rmse;
    }

    const std::string folder_ = filmOf("corridor-loop", "--size 320x240 --every 3");
    std::size_t false_loops_ = 0;
};

TEST_F(FalseLoops, oneInTenKeyframesDoNotBendTheMap) {
    if (HasFatalFailure()) return;
    const double honest_m = run(false);
    EXPECT_EQ(false_loops_, 0u);
    EXPECT_LT(honest_m, 0.1);  // a quarter of the pixels, a third of the frames
    const double deceived_m = run(true);
    EXPECT_GT(false_loops_, 15u);
    EXPECT_LE(deceived_m, 1.1 * honest_m);
    RecordProperty("honest_m", std::to_string(honest_m));
    RecordProperty("deceived_m", std::to_string(deceived_m));
    RecordProperty("false_loops", std::to_string(false_loops_));
}

}  // namespace
}  // namespace rgbd_graphslam
