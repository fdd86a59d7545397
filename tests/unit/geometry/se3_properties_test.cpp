/** What holds for any rigid motion. */
#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

constexpr int trials = 2000;

double distanceFromRotation(const Eigen::Matrix3d& R) {
    return (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() + std::abs(R.determinant() - 1);
}

double difference(const SE3& a, const SE3& b) {
    return (a.R - b.R).norm() + (a.t - b.t).norm();
}

TEST(SE3Properties, expIsARotationAboutItsVector) {
    RandomInputs random(1);
    for (int i = 0; i < trials; ++i) {
        const Eigen::Vector3d w = random.rotation();
        const Eigen::Matrix3d R = rotationExp(w);
        EXPECT_LT(distanceFromRotation(R), 1e-14) << w.transpose();
        EXPECT_LT((R * w - w).norm(), 1e-14) << w.transpose();
        EXPECT_LT((R * rotationExp(-w) - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    }
}

TEST(SE3Properties, logInvertsExpFromZeroToPi) {
    RandomInputs random(2);
    for (int i = 0; i < trials; ++i) {
        const Eigen::Vector3d w = random.rotation();
        EXPECT_LT((rotationLog(rotationExp(w)) - w).norm(), 1e-13 * (1 + w.norm()))
            << w.norm() << " rad about " << w.normalized().transpose();
    }
}

TEST(SE3Properties, expInvertsLogAtPiItself) {
    RandomInputs random(3);
    for (int i = 0; i < trials; ++i) {
        // Half a turn has two vectors; either will do.
        const Eigen::Matrix3d R = rotationExp(M_PI * random.direction());
        const Eigen::Vector3d w = rotationLog(R);
        EXPECT_LT((rotationExp(w) - R).norm(), 1e-14);
        EXPECT_NEAR(w.norm(), M_PI, 1e-14);
    }
}

TEST(SE3Properties, motionsAreAGroup) {
    RandomInputs random(4);
    for (int i = 0; i < trials; ++i) {
        const SE3 a = random.pose(), b = random.pose(), c = random.pose();
        const Eigen::Vector3d p = random.vector(10);
        EXPECT_LT(difference(a * a.inverse(), SE3()), 1e-13);
        EXPECT_LT(difference(a.inverse() * a, SE3()), 1e-13);
        EXPECT_LT(difference((a * b).inverse(), b.inverse() * a.inverse()), 1e-13);
        EXPECT_LT(difference((a * b) * c, a * (b * c)), 1e-13);
        EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-13);
    }
}

TEST(SE3Properties, minusInvertsRetract) {
    RandomInputs random(5);
    for (int i = 0; i < trials; ++i) {
        const SE3 pose = random.pose();
        Vector6d delta;
        delta << random.vector(2), random.rotation();
        EXPECT_LT(difference(pose.retract(pose.retract(delta).minus(pose)), pose.retract(delta)),
                  1e-12);
        EXPECT_LT(distanceFromRotation(pose.retract(delta).R), 1e-14);
    }
}

TEST(SE3Properties, retractedPointsMoveAsTheDerivativeSays) {
    RandomInputs random(6);
    constexpr double h = 1e-6;
    for (int i = 0; i < trials; ++i) {
        const SE3 pose = random.pose();
        const Eigen::Vector3d p = random.vector(3), q = pose * p;
        Eigen::Matrix<double, 3, 6> analytic, numeric;
        analytic << Eigen::Matrix3d::Identity(), -skew(q);
        for (int k = 0; k < 6; ++k) {
            const Vector6d step = h * Vector6d::Unit(k);
            numeric.col(k) = (pose.retract(step) * p - pose.retract(-step) * p) / (2 * h);
        }
        EXPECT_LT((analytic - numeric).norm(), 1e-8);
    }
}

TEST(SE3Properties, quaternionsGiveTheSameMotion) {
    RandomInputs random(7);
    for (int i = 0; i < trials; ++i) {
        const SE3 pose = random.pose();
        EXPECT_LT(difference(SE3(pose.quaternion(), pose.t), pose), 1e-14);
    }
}

TEST(SE3Properties, interpolationGoesFromEndToEndEvenly) {
    RandomInputs random(8);
    for (int i = 0; i < trials; ++i) {
        const SE3 from = random.pose();
        Vector6d delta;
        delta << random.vector(2), random.uniform(0, 3) * random.direction();
        const SE3 to = from.retract(delta);
        EXPECT_LT(difference(interpolate(from, to, 0), from), 1e-13);
        EXPECT_LT(difference(interpolate(from, to, 1), to), 1e-13);
        const double share = random.uniform(0, 1);
        const double turned = (interpolate(from, to, share) * from.inverse()).angle();
        EXPECT_NEAR(turned, share * (to * from.inverse()).angle(), 1e-7);
    }
}

TEST(SE3Properties, orthonormalizedMovesLittleAndIsARotation) {
    RandomInputs random(9);
    for (int i = 0; i < trials; ++i) {
        const Eigen::Matrix3d R = rotationExp(random.rotation());
        Eigen::Matrix3d spoilt = R;
        for (int k = 0; k < 9; ++k) spoilt(k) += random.uniform(-1e-6, 1e-6);
        EXPECT_LT(distanceFromRotation(orthonormalized(spoilt)), 1e-14);
        EXPECT_LT((orthonormalized(spoilt) - R).norm(), 1e-5);
    }
}

/** A pose handed on from frame to frame, each time tied to a keyframe and untied again. */
SE3 handedOn(int links, bool with_orthonormalizing) {
    RandomInputs random(10);
    SE3 pose = random.pose();
    for (int i = 0; i < links; ++i) {
        const SE3 T_cam_reference = random.pose() * pose.inverse();
        pose = T_cam_reference.inverse() * random.pose();
        if (with_orthonormalizing) pose.R = orthonormalized(pose.R);
    }
    return pose;
}

TEST(SE3Properties, chainsOfInversesStayRigidWhereTheyAreOrthonormalized) {
    EXPECT_LT(distanceFromRotation(handedOn(100000, true).R), 1e-14);
}

TEST(SE3Properties, anInverseThatIsATransposeCarriesErrorsOn) {
    // Why chains must be orthonormalized: what R lacks of a rotation comes back doubled.
    Eigen::Matrix3d R = 1.000001 * rotationExp({0.3, 0.2, 0.1});
    const double before = distanceFromRotation(R);
    for (int i = 0; i < 10; ++i) R = R * R.transpose() * R;
    EXPECT_GT(distanceFromRotation(R), 1000 * before);
    EXPECT_LT(distanceFromRotation(orthonormalized(R)), 1e-14);
}

}  // namespace
}  // namespace rgbd_graphslam
