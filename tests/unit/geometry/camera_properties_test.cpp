/** What holds for any camera. */
#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

constexpr int trials = 500;

Eigen::Vector2d randomPixel(const Camera& camera, RandomInputs& random) {
    return {random.uniform(0, camera.width - 1), random.uniform(0, camera.height - 1)};
}

TEST(CameraProperties, projectInvertsUnproject) {
    RandomInputs random(1);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera().pinhole();
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        const double depth = random.uniform(0.1, 50);
        const Eigen::Vector3d p = camera.unproject(pixel.x(), pixel.y(), depth);
        EXPECT_EQ(p.z(), depth);
        EXPECT_LT((camera.project(p) - pixel).norm(), 1e-10);
        EXPECT_LT(
            (camera.unproject(camera.project(p).x(), camera.project(p).y(), depth) - p).norm(),
            1e-10);
    }
}

TEST(CameraProperties, projectionDoesNotDependOnTheDistance) {
    RandomInputs random(2);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera().pinhole();
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        const Eigen::Vector3d p = camera.unproject(pixel.x(), pixel.y(), random.uniform(0.1, 50));
        EXPECT_LT((camera.project(random.uniform(0.1, 10) * p) - pixel).norm(), 1e-9);
    }
}

TEST(CameraProperties, distortInvertsUndistortInTheWholeImage) {
    RandomInputs random(3);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera();
        const Eigen::Vector2d seen = randomPixel(camera, random);
        EXPECT_LT((camera.unrectify(camera.rectify(seen)) - seen).norm(), 0.01)
            << camera.width << " " << seen.transpose();
    }
}

TEST(CameraProperties, whatCanBeUndoneIsUndoneInTheWholeImage) {
    RandomInputs random(7);
    int undone = 0;
    for (int i = 0; i < trials; ++i) {
        Intrinsics intrinsics = random.camera().intrinsics();
        for (double& k : std::get<BrownLens>(intrinsics.lens).coefficients)
            k *= random.uniform(0, 4);
        const Camera camera = intrinsics;
        if (!camera.isInvertible()) continue;
        ++undone;
        for (int pixel = 0; pixel < 20; ++pixel) {
            const Eigen::Vector2d seen = randomPixel(camera, random);
            EXPECT_LT((camera.unrectify(camera.rectify(seen)) - seen).norm(), 1.1);
        }
    }
    EXPECT_GT(undone, trials / 4);
    EXPECT_LT(undone, trials);
}

/** Past a radius at which the distorted one stops growing, two points share a pixel. */
TEST(CameraProperties, lensesThatFoldTheImageOverCannotBeUndone) {
    RandomInputs random(6);
    int folded = 0;
    for (int i = 0; i < trials; ++i) {
        Intrinsics camera = random.camera().intrinsics();
        const double k1 = random.uniform(-4, 0), folds_at = std::sqrt(-1 / (3 * k1));
        const double farthest = folds_at * (1 + k1 * folds_at * folds_at);
        camera.lens = BrownLens{{k1}};
        const Eigen::Vector2d corner(
            std::max(camera.cx, camera.width - 1 - camera.cx) / camera.fx,
            std::max(camera.cy, camera.height - 1 - camera.cy) / camera.fy);
        if (corner.norm() < 1.02 * farthest) continue;
        ++folded;
        EXPECT_FALSE(CameraModel(camera).isInvertible()) << k1;
    }
    EXPECT_GT(folded, trials / 4);
}

TEST(CameraProperties, aLensOfNoNumbersCannotBeUndone) {
    for (const double bad : {std::nan(""), double(INFINITY), 1e300}) {
        for (int k = 0; k < 8; ++k) {
            Intrinsics camera;
            std::get<BrownLens>(camera.lens).coefficients[k] = bad;
            EXPECT_FALSE(CameraModel(camera).isInvertible()) << k << " " << bad;
        }
    }
}

TEST(CameraProperties, aPointComesBackThroughTheLens) {
    RandomInputs random(4);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera();
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        const Camera pinhole = camera.pinhole();
        const Eigen::Vector3d p = pinhole.unproject(pixel.x(), pixel.y(), random.uniform(0.3, 8));
        const Eigen::Vector2d seen = camera.project(p);
        if (!camera.contains(seen)) continue;
        EXPECT_LT((camera.unproject(seen.x(), seen.y(), p.z()) - p).norm(), 1e-4 * p.z());
    }
}

TEST(CameraProperties, withoutDistortionNothingIsMoved) {
    RandomInputs random(5);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera().pinhole();
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        EXPECT_FALSE(camera.hasDistortion());
        EXPECT_LT((camera.unrectify(pixel) - pixel).norm(), 1e-10);
        EXPECT_LT((camera.rectify(pixel) - pixel).norm(), 1e-10);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
