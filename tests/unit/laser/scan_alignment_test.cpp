/** Scans, their nearest neighbors, ICP and correlation. */
#include "rgbd_graphslam/laser/scan_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "../../support/floor_plan.h"
#include "rgbd_graphslam/laser/correlation_field.h"

namespace rgbd_graphslam {
namespace {

FloorPlan room() {
    FloorPlan plan;
    plan.addBox(0, 0, 6, 4);
    plan.addBox(2, 3.2, 3, 4);
    plan.addBox(5.3, 0, 6, 0.5);
    return plan;
}

FloorPlan corridor() {
    FloorPlan plan;
    plan.addBox(-100, 0, 100, 2);
    return plan;
}

PlanarScan planar(const FloorPlan& plan, const PlanarPose& pose, RandomInputs& random,
                  double sigma_m = 0.01) {
    return toPlanarScan(*scanOf(plan, pose, 1, random, sigma_m), 0.1, 20);
}

Eigen::Vector3d difference(const PlanarPose& found, const PlanarPose& truth) {
    const PlanarPose off = truth.inverse() * found;
    const Eigen::Vector2d t = rotated(-off.yaw, positionOf(off));
    return {t.x(), t.y(), wrapped(off.yaw)};
}

TEST(PlanarScan, putsPointsWhereSensorPoseSays) {
    RandomInputs random(1);
    auto scan = scanOf(room(), {3, 2, 0}, 1, random, 0);
    scan->sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, 0);
    const PlanarScan upright = toPlanarScan(*scan, 0.1, 20);
    scan->sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, M_PI);  // upside down
    const PlanarScan hanging = toPlanarScan(*scan, 0.1, 20);
    ASSERT_EQ(upright.points.size(), hanging.points.size());
    for (std::size_t i = 0; i < upright.points.size(); ++i) {
        EXPECT_NEAR(upright.points[i].p.y(), -hanging.points[i].p.y(), 1e-5);
        EXPECT_NEAR(upright.points[i].p.x(), hanging.points[i].p.x(), 1e-5);
    }
    EXPECT_NEAR(upright.origin.x(), 0.2, 1e-9);
}

TEST(PlanarScan, normalsFaceTheScanner) {
    RandomInputs random(1);
    const PlanarScan scan = planar(room(), {3, 2, 0.3}, random);
    std::size_t with_normal = 0;
    for (const ScanPoint& point : scan.points) {
        if (!point.hasNormal()) continue;
        ++with_normal;
        EXPECT_GT(point.normal.dot(scan.origin - point.p), 0);
    }
    EXPECT_GT(with_normal, 0.8 * static_cast<double>(scan.points.size()));
}

TEST(PlanarScan, readingsAtTheMaximumAreNone) {
    RandomInputs random(1);
    auto scan = scanOf(room(), {3, 2, 0}, 1, random);
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
        scan->setScanRange(i, scan->maxRange);
        scan->setScanRangeValidity(i, true);
    }
    EXPECT_TRUE(toPlanarScan(*scan, 0.1, 100).points.empty());
}

TEST(PlanarScan, tiltedScannersAreTold) {
    RandomInputs random(1);
    auto scan = scanOf(room(), {3, 2, 0}, 1, random);
    EXPECT_EQ(mountingProblem(*scan), "");
    scan->sensorPose = mrpt::poses::CPose3D(0, 0, 0.3, 0, 0.5, 0);
    EXPECT_NE(mountingProblem(*scan).find("tilted by 29 degrees"), std::string::npos);
}

TEST(PointIndex, findsWhatTryingAllFinds) {
    RandomInputs random(3);
    std::vector<ScanPoint> points;
    for (int i = 0; i < 500; ++i) {
        const double angle = 6.28 * random.uniform(0, 1);
        points.push_back({{10 * random.uniform(0, 1), 8 * random.uniform(0, 1)},
                          {std::cos(angle), std::sin(angle)}});
    }
    const PointIndex index(points, 1e-6);
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector2d p(12 * random.uniform(0, 1) - 1, 10 * random.uniform(0, 1) - 1);
        const Eigen::Vector2d normal = points[static_cast<std::size_t>(i)].normal;
        const ScanPoint* best = nullptr;
        for (const ScanPoint& point : points) {
            if ((point.p - p).norm() > 0.4 || point.normal.dot(normal) < 0.5) continue;
            if (!best || (point.p - p).norm() < (best->p - p).norm()) best = &point;
        }
        const ScanPoint* const found = index.nearest(p, normal, 0.4);
        ASSERT_EQ(!found, !best);
        if (best) {
            EXPECT_EQ(found->p, best->p);
        }
    }
}

TEST(ScanAlignment, findsTheMotionBetweenTwoScans) {
    RandomInputs random(5);
    const PlanarPose a{3, 2, 0.3}, b{3.2, 1.9, 0.45};
    const PointIndex reference(planar(room(), a, random).points);
    const auto found = alignScan(reference, planar(room(), b, random).points, {}, std::nullopt, {});
    ASSERT_TRUE(found);
    EXPECT_LT(difference(found->T_ref_scan, a.inverse() * b).norm(), 0.01);
    EXPECT_GT(found->inlier_share, 0.9);
}

TEST(ScanAlignment, informationIsTheInverseOfTheScatter) {
    constexpr int trials = 200;
    constexpr double sigma_m = 0.02;
    RandomInputs random(7);
    const PlanarPose pose{3, 2, 0.3};
    const PointIndex reference(planar(room(), pose, random, 0).points, 0.005);
    AlignmentOptions options;
    options.sigma_m = sigma_m;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(), information = scatter;
    for (int t = 0; t < trials; ++t) {
        const auto found = alignScan(reference, planar(room(), pose, random, sigma_m).points, {},
                                     std::nullopt, options);
        ASSERT_TRUE(found);
        const Eigen::Vector3d d = difference(found->T_ref_scan, {});
        scatter += d * d.transpose() / trials;
        information += found->information / trials;
    }
    const double ratio = (information * scatter).trace() / 3;
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 2);
}

TEST(ScanAlignment, aCorridorLeavesItsDirectionToThePrior) {
    RandomInputs random(9);
    const PlanarPose a{0, 1, 0}, b{0.3, 1.05, 0.02};
    const PointIndex reference(planar(corridor(), a, random).points);
    const auto scan = planar(corridor(), b, random).points;
    const PointIndex exact(planar(corridor(), a, random, 0).points);
    EXPECT_FALSE(alignScan(exact, planar(corridor(), b, random, 0).points, {}, std::nullopt, {}));
    const PlanarPrior prior{{0.31, 0, 0},
                            Eigen::Vector3d(1 / 0.0025, 1 / 0.0025, 1 / 0.0025).asDiagonal()};
    const auto found = alignScan(reference, scan, prior.mean, prior, {});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->T_ref_scan.x, 0.31, 0.005);
    EXPECT_NEAR(found->T_ref_scan.y, 0.05, 0.01);
    EXPECT_LT(found->information(0, 0), 0.02 * found->information(1, 1));
}

TEST(CorrelationField, findsTheBestOfAllPoses) {
    RandomInputs random(11);
    const PlanarPose a{2, 1.5, 0}, b{3.4, 1.9, 0.3};
    const CorrelationField field(planar(room(), a, random).points, 0.05, 0.07);
    const auto found =
        field.match(planar(room(), b, random).points, {0.6, 0.9, 0}, {1.5, 0.6, 0.02});
    ASSERT_TRUE(found);
    const Eigen::Vector3d off = difference(found->T_ref_scan, a.inverse() * b);
    EXPECT_LT(off.head<2>().norm(), 0.08);
    EXPECT_LT(std::abs(off.z()), 0.03);
    EXPECT_LT(found->runner_up, 0.85 * found->score);
}

TEST(CorrelationField, tellsThatACorridorLooksAlikeEverywhere) {
    RandomInputs random(13);
    std::vector<ScanPoint> points;
    for (double x = -3; x <= 3; x += 0.25) {
        for (const ScanPoint& point : planar(corridor(), {0, 1, 0}, random).points) {
            points.push_back({point.p + Eigen::Vector2d(x, 0), point.normal});
        }
    }
    const CorrelationField field(points, 0.05, 0.07);
    const auto found =
        field.match(planar(corridor(), {0.5, 1, 0}, random).points, {}, {2, 0.2, 0.02});
    ASSERT_TRUE(found);
    EXPECT_GT(found->runner_up, 0.92 * found->score);
}

TEST(CorrelationField, beamsThroughWallsContradict) {
    RandomInputs random(15);
    const PlanarScan scan = planar(room(), {3, 1.5, 0}, random);
    const CorrelationField field(scan.points, 0.05, 0.07);
    std::vector<Eigen::Vector2d> same, farther;
    for (const ScanPoint& point : scan.points) {
        same.push_back(point.p);
        farther.push_back(scan.origin + 1.8 * (point.p - scan.origin));
    }
    EXPECT_LT(field.contradiction(scan.origin, same), 0.05);
    EXPECT_GT(field.contradiction(scan.origin, farther), 0.5);
}

}  // namespace
}  // namespace rgbd_graphslam
