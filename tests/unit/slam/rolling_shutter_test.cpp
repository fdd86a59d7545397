#include "rgbd_graphslam/slam/rolling_shutter.h"

#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

constexpr int keyframes = 40, landmarks = 300;

/** A hand that trembles at two frequencies before a scene of some depth. */
SE3 trembling(double t) {
    return {
        rotationExp({0.05 * std::sin(9 * t), 0.06 * std::sin(7 * t + 1), 0.03 * std::sin(5 * t)}),
        Eigen::Vector3d(0.05 * std::sin(6 * t), 0.04 * std::sin(8 * t + 2), 0.02 * t)};
}

/** Views of the scene and, as a bundle adjustment leaves it, poses and points that are a little
 *  wrong. \param readout_s of the camera */
std::vector<RowObservation> filmed(double readout_s, double noise_px, unsigned seed) {
    RandomInputs random(seed);
    const Camera camera;
    std::vector<Eigen::Vector3d> points;
    for (int l = 0; l < landmarks; ++l) {
        points.push_back(camera.unproject(random.uniform(60, 580), random.uniform(60, 420),
                                          random.uniform(1.5, 4)));
    }
    const auto projected = [&](int landmark, double t) {
        return camera.project(trembling(t).inverse() * points[landmark]);
    };
    std::vector<RowObservation> observations;
    for (int k = 0; k < keyframes; ++k) {
        const double t = 0.2 * k;
        const Vector6d pose_error = random.tangent(1e-3, 5e-4);
        const Eigen::Matrix3d R = trembling(t).R.transpose();
        for (int l = 0; l < landmarks; ++l) {
            const Eigen::Vector3d p = trembling(t).inverse() * points[l];
            RowObservation o;
            o.keyframe = k;
            o.landmark = l;
            o.row = projected(l, t).y() / camera.height - 0.5;
            o.velocity_px_s = (projected(l, t + 1e-3) - projected(l, t - 1e-3)) / 2e-3;
            const Matrix23d J = camera.projectionJacobian(p);
            o.by_pose << J, -J * skew(p);
            o.by_landmark = J * R;
            o.residual_px =
                projected(l, t + readout_s * o.row) - projected(l, t) + o.by_pose * pose_error +
                noise_px * Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
            observations.push_back(o);
        }
    }
    return observations;
}

TEST(RollingShutter, readoutIsFoundWhateverPosesMadeOfIt) {
    for (const double readout_s : {0.008, 0.03, -0.02}) {
        const auto found = estimateReadoutTime(filmed(readout_s, 0.5, 1));
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->seconds, readout_s, 0.1 * std::abs(readout_s));
        EXPECT_LT(std::abs(found->seconds - readout_s), 5 * found->sigma_s + 0.05 * 0.03);
        EXPECT_TRUE(isRollingShutter(*found)) << readout_s;
    }
}

TEST(RollingShutter, noiseOfAGlobalShutterIsNoAlarm) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto found = estimateReadoutTime(filmed(0, 1, seed));
        ASSERT_TRUE(found);
        EXPECT_FALSE(isRollingShutter(*found)) << seed << ": " << found->seconds;
        EXPECT_LT(std::abs(found->seconds), 6 * found->sigma_s);
    }
}

TEST(RollingShutter, whatNoCameraTakesIsNoAlarm) {
    EXPECT_TRUE(isRollingShutter({0.033, 0.002, 5000}));
    EXPECT_TRUE(isRollingShutter({-0.033, 0.002, 5000}));
    EXPECT_FALSE(isRollingShutter({0.169, 0.024, 5000})) << "of a film without one";
    EXPECT_FALSE(isRollingShutter({-0.169, 0.024, 5000}));
}

TEST(RollingShutter, aCameraAtRestTellsNothing) {
    auto observations = filmed(0.03, 0.5, 1);
    for (RowObservation& o : observations) o.velocity_px_s.setZero();
    EXPECT_FALSE(estimateReadoutTime(observations));
    observations.resize(100);
    EXPECT_FALSE(estimateReadoutTime(observations));
}

}  // namespace
}  // namespace rgbd_graphslam
