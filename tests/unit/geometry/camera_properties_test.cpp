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
        const Camera camera = random.camera();
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
        const Camera camera = random.camera();
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
        EXPECT_LT((camera.distort(camera.undistort(seen)) - seen).norm(), 0.01)
            << camera.width << " " << seen.transpose();
    }
}

TEST(CameraProperties, aPointComesBackThroughTheLens) {
    RandomInputs random(4);
    for (int i = 0; i < trials; ++i) {
        const Camera camera = random.camera();
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        const Eigen::Vector3d p = camera.unproject(pixel.x(), pixel.y(), random.uniform(0.3, 8));
        const Eigen::Vector2d seen = camera.distort(camera.project(p));
        if (!camera.contains(seen)) continue;
        const Eigen::Vector2d back = camera.undistort(seen);
        EXPECT_LT((camera.unproject(back.x(), back.y(), p.z()) - p).norm(), 1e-4 * p.z());
    }
}

TEST(CameraProperties, withoutDistortionNothingIsMoved) {
    RandomInputs random(5);
    for (int i = 0; i < trials; ++i) {
        Camera camera = random.camera();
        camera.distortion = {};
        const Eigen::Vector2d pixel = randomPixel(camera, random);
        EXPECT_FALSE(camera.hasDistortion());
        EXPECT_LT((camera.distort(pixel) - pixel).norm(), 1e-10);
        EXPECT_LT((camera.undistort(pixel) - pixel).norm(), 1e-10);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
