#include "rgbd_graphslam/viewer/cpu_budget.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

CpuBudget::TimePoint at(int ms) {
    return CpuBudget::TimePoint(std::chrono::milliseconds(ms));
}

TEST(CpuBudget, restsUntilTheShareIsKept) {
    CpuBudget budget(0.1, 7);
    EXPECT_TRUE(budget.allows(at(0)));
    budget.spent(at(1000), 7.02);  // 20 ms of work are 10 % of 200 ms
    EXPECT_FALSE(budget.allows(at(1150)));
    EXPECT_TRUE(budget.allows(at(1250)));
}

TEST(CpuBudget, whatWasTakenInBetweenCounts) {
    CpuBudget budget(0.1, 0);
    budget.spent(at(0), 0.01);
    budget.spent(at(1000), 0.05);  // 10 ms for drawing, 30 for messages
    EXPECT_FALSE(budget.allows(at(1350)));
    EXPECT_TRUE(budget.allows(at(1450)));
}

TEST(CpuBudget, neverExceedsTheShareInTheLongRun) {
    CpuBudget budget(0.04, 0);
    double cpu_s = 0;
    for (int ms = 0; ms < 60000; ++ms) {
        if (!budget.allows(at(ms))) continue;
        cpu_s += 0.03;
        budget.spent(at(ms), cpu_s);
    }
    EXPECT_GT(cpu_s, 0.9 * 0.04 * 60);
    EXPECT_LT(cpu_s, 1.1 * 0.04 * 60);
}

TEST(CpuBudget, tellsHowLongItRests) {
    CpuBudget budget(0.1, 0);
    budget.setShare(0.2);
    budget.spent(at(1000), 0.02);
    EXPECT_NEAR(budget.rest(at(1000)), 0.1, 1e-9);
    EXPECT_LE(budget.rest(at(1200)), 0);
}

TEST(ShareBesideSlam, isNextToNothingOnAMachineThatIsBusy) {
    EXPECT_LT(shareBesideSlam(0), 0.02);
    EXPECT_EQ(shareBesideSlam(0.5), shareBesideSlam(0));
    EXPECT_GT(shareBesideSlam(1.5), 0.1);
    EXPECT_LE(shareBesideSlam(60), 0.25);
}

}  // namespace
}  // namespace rgbd_graphslam
