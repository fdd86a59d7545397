/** Every analytic derivative against numeric differences, on any input. */
#include <gtest/gtest.h>

#include "../../support/random_inputs.h"
#include "rgbd_graphslam/slam/relative_pose.h"
#include "rgbd_graphslam/slam/reprojection.h"
#include "rgbd_graphslam/slam/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

constexpr int trials = 500;

TEST(Derivatives, ofTheReprojectionByThePoint) {
    RandomInputs random(1);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera();
        const Keypoint keypoint{static_cast<float>(random.uniform(0, camera.width)),
                                static_cast<float>(random.uniform(0, camera.height)),
                                i % 4 ? static_cast<float>(random.uniform(0.3, 9)) : 0, 0, 0};
        const Measurement m = measurementOf(keypoint, random.uniform(1, 3), SensorOptions{});
        const Eigen::Vector3d p =
            camera.unproject(random.uniform(0, camera.width), random.uniform(0, camera.height),
                             random.uniform(0.3, 9));
        const Eigen::Matrix3d analytic = residualJacobian(camera, p, m);
        const double h = 1e-5 * p.z();
        Eigen::Matrix3d numeric;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
            numeric.col(k) =
                (residual(camera, p + step, m) - residual(camera, p - step, m)) / (2 * h);
        }
        EXPECT_LT((analytic - numeric).norm(), 1e-7 * analytic.norm()) << i;
    }
}

/** On (0, 3]; near pi the logarithm jumps. */
Eigen::Vector3d shortOfHalfATurn(RandomInputs& random) {
    return std::min(3.0, random.angle()) * random.direction();
}

TEST(Derivatives, ofARelativePoseByBothEnds) {
    RandomInputs random(2);
    constexpr double h = 1e-6;
    for (int i = 0; i < trials; ++i) {
        const SE3 from = random.pose(), to = random.pose();
        const SE3 error(rotationExp(shortOfHalfATurn(random)), random.vector(3));
        const SE3 measured = from.inverse() * to * error;
        Matrix6d analytic, by_from, by_to;
        relativePoseResidual(from, to, measured, &analytic);
        for (int k = 0; k < 6; ++k) {
            const Vector6d step = h * Vector6d::Unit(k);
            by_to.col(k) = (relativePoseResidual(from, to.retract(step), measured) -
                            relativePoseResidual(from, to.retract(-step), measured)) /
                           (2 * h);
            by_from.col(k) = (relativePoseResidual(from.retract(step), to, measured) -
                              relativePoseResidual(from.retract(-step), to, measured)) /
                             (2 * h);
        }
        EXPECT_LT((analytic - by_to).norm(), 1e-6 * analytic.norm()) << i;
        EXPECT_LT((-analytic - by_from).norm(), 1e-6 * analytic.norm()) << i;
    }
}

TEST(Derivatives, ofTheLogarithmByALeftPerturbation) {
    RandomInputs random(3);
    constexpr double h = 1e-6;
    for (int i = 0; i < trials; ++i) {
        const Eigen::Vector3d w = shortOfHalfATurn(random);
        Eigen::Matrix3d numeric;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
            numeric.col(k) = (rotationLog(rotationExp(step) * rotationExp(w)) -
                              rotationLog(rotationExp(-step) * rotationExp(w))) /
                             (2 * h);
        }
        EXPECT_LT((inverseLeftJacobian(w) - numeric).norm(), 1e-6) << w.norm();
    }
}

TEST(Derivatives, aKernelsWeightIsTheSlopeOfItsCost) {
    RandomInputs random(4);
    for (const auto kernel : {huber, gemanMcClure}) {
        for (int i = 0; i < trials; ++i) {
            const double limit = random.uniform(1, 10), chi2 = limit * random.uniform(0.01, 50);
            const double h = 1e-6 * chi2;
            if (std::abs(chi2 - limit) < 2 * h) continue;  // Huber's second derivative jumps
            const double slope =
                (kernel(chi2 + h, limit).cost - kernel(chi2 - h, limit).cost) / (2 * h);
            EXPECT_NEAR(kernel(chi2, limit).weight, slope, 1e-6);
            EXPECT_LE(kernel(chi2, limit).cost, chi2);
        }
    }
}

TEST(Derivatives, kernelsLeaveSmallResidualsAlone) {
    for (const auto kernel : {huber, gemanMcClure}) {
        EXPECT_EQ(kernel(0, 5).cost, 0);
        EXPECT_EQ(kernel(0, 5).weight, 1);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
