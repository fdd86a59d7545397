#include "rgbd_graphslam/slam/loop_plausibility.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

constexpr int keyframes = 41;

/** T_cam_world of a camera at x. */
SE3 at(double x) {
    return {Eigen::Matrix3d::Identity(), {-x, 0, 0}};
}

/** 20 m out and back again along x, a meter from keyframe to keyframe. */
class LoopPlausibilityTest : public testing::Test {
  protected:
    explicit LoopPlausibilityTest(int dead_reckoned = -1) {
        for (int k = 0; k < keyframes; ++k) {
            const double x = std::min(k, keyframes - 1 - k);
            map_.addKeyframe({}, at(x), 0, k == dead_reckoned ? Link::DeadReckoned : Link::Tracked);
        }
        plausibility_.travelTo(keyframes - 1);
    }

    /** That finds the last keyframe `error_m` beside keyframe `from`. */
    static VerifiedLoop loop(int from, double error_m, int inliers = 100) {
        VerifiedLoop loop;
        loop.edge.from = from;
        loop.edge.to = keyframes - 1;
        loop.edge.T_from_to.t.y() = error_m;
        loop.edge.inliers = inliers;
        return loop;
    }
    std::optional<VerifiedLoop> likeliest(std::vector<VerifiedLoop> loops) const {
        for (VerifiedLoop& loop : loops) loop.asked = plausibility_.asked(loop.edge);
        return plausibility_.likeliest(std::move(loops));
    }

    const LoopOptions options_;
    SlamMap map_{1.2, 8};
    std::vector<PoseEdge> loops_;
    LoopPlausibility plausibility_{options_, map_, loops_};
};

TEST_F(LoopPlausibilityTest, asksHowFarTheLaterKeyframeWouldMove) {
    EXPECT_NEAR(plausibility_.asked(loop(0, 0.2).edge).m, 0.2, 1e-12);
    EXPECT_NEAR(plausibility_.asked(loop(3, 0).edge).m, 3, 1e-12);
}

TEST_F(LoopPlausibilityTest, takesWhatThePathExplains) {
    // 0.3 m and 2 % of 40 m
    EXPECT_TRUE(likeliest({loop(0, 1.0)}));
    EXPECT_FALSE(likeliest({loop(0, 1.2)}));
}

TEST_F(LoopPlausibilityTest, prefersWhatAsksForLess) {
    const auto best = likeliest({loop(0, 0.8), loop(1, 0), loop(0, 0.1)});
    ASSERT_TRUE(best);
    EXPECT_NEAR(best->asked.m, 0.1, 1e-12);
}

TEST_F(LoopPlausibilityTest, fewInliersAreNoContender) {
    const auto best = likeliest({loop(0, 0.8, 100), loop(0, 0.1, 30)});
    ASSERT_TRUE(best);
    EXPECT_EQ(best->edge.inliers, 100);
}

TEST_F(LoopPlausibilityTest, anotherLoopShortensTheWayOnWhichDriftGathers) {
    PoseEdge earlier;
    earlier.from = 1;
    earlier.to = keyframes - 2;
    loops_.push_back(earlier);
    EXPECT_FALSE(likeliest({loop(0, 1.0)}));
    EXPECT_TRUE(likeliest({loop(0, 0.3)}));
}

TEST_F(LoopPlausibilityTest, viewsFarApartShareNothing) {
    EXPECT_TRUE(plausibility_.mightSee(keyframes - 1, 2));
    EXPECT_FALSE(plausibility_.mightSee(keyframes - 1, 20));
}

TEST_F(LoopPlausibilityTest, otherSubmapsMayLieAnywhere) {
    const int elsewhere = map_.addKeyframe({}, at(1000), keyframes);
    plausibility_.travelTo(elsewhere);
    EXPECT_TRUE(plausibility_.mightSee(elsewhere, 0));
}

TEST_F(LoopPlausibilityTest, aLoopThatTheGraphOverruledIsNotFollowed) {
    VerifiedLoop asked = loop(0, 0.8);
    asked.asked = plausibility_.asked(asked.edge);
    EXPECT_FALSE(plausibility_.followed(asked));
    map_.setPose(keyframes - 1, SE3(Eigen::Matrix3d::Identity(), {0, -0.79, 0}));
    EXPECT_TRUE(plausibility_.followed(asked));
}

class AcrossDeadReckoning : public LoopPlausibilityTest {
  protected:
    AcrossDeadReckoning() : LoopPlausibilityTest(20) {}
};

TEST_F(AcrossDeadReckoning, moreDriftIsExplained) {
    EXPECT_TRUE(likeliest({loop(0, 1.5)}));
    EXPECT_FALSE(likeliest({loop(0, 1.7)}));
}

}  // namespace
}  // namespace rgbd_graphslam
