#include "rgbd_graphslam/estimation/robust_kernel.h"

#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

constexpr KernelShape shapes[] = {KernelShape::None, KernelShape::Huber, KernelShape::Cauchy,
                                  KernelShape::GemanMcClure};

TEST(RobustKernel, weightIsTheSlopeOfTheCost) {
    RandomInputs random(4);
    for (const KernelShape shape : shapes) {
        for (int i = 0; i < 500; ++i) {
            const RobustKernel kernel{shape, random.uniform(1, 10)};
            const double chi2 = kernel.limit * random.uniform(0.01, 50);
            const double h = 1e-6 * chi2;
            if (std::abs(chi2 - kernel.limit) < 2 * h) continue;  // Huber's curvature jumps
            const double slope = (kernel(chi2 + h).cost - kernel(chi2 - h).cost) / (2 * h);
            EXPECT_NEAR(kernel(chi2).weight, slope, 1e-6);
            EXPECT_LE(kernel(chi2).cost, chi2);
        }
    }
}

TEST(RobustKernel, leavesSmallResidualsAlone) {
    for (const KernelShape shape : shapes) {
        const RobustKernel kernel{shape, 5};
        EXPECT_EQ(kernel(0).cost, 0);
        EXPECT_EQ(kernel(0).weight, 1);
        EXPECT_NEAR(kernel(1e-4).cost, 1e-4, 1e-8);
    }
}

TEST(RobustKernel, limitsTheInfluenceOfFarResiduals) {
    EXPECT_EQ((RobustKernel{KernelShape::None, 5}(500).weight), 1);
    EXPECT_NEAR((RobustKernel{KernelShape::Huber, 5}(500).weight), 0.1, 1e-12);
    EXPECT_NEAR((RobustKernel{KernelShape::Cauchy, 5}(5).weight), 0.5, 1e-12);
    EXPECT_NEAR((RobustKernel{KernelShape::GemanMcClure, 5}(5).weight), 0.25, 1e-12);
    EXPECT_LT((RobustKernel{KernelShape::GemanMcClure, 5}(1e9).cost), 5);
}

}  // namespace
}  // namespace rgbd_graphslam
