/** Lens models as Brown's. */
#include "../../../libs/dataset/src/lens_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

const Camera kinect_azure{1280, 720, 605, 605, 640, 366, {}};

TEST(LensFit, brownsModelStaysAsItIs) {
    Camera camera;
    EXPECT_EQ(fitLens("plumb_bob", {0.1, -0.2, 0.001, -0.002, 0.05}, camera), 0);
    EXPECT_EQ(camera.distortion, (std::array<double, 5>{0.1, -0.2, 0.001, -0.002, 0.05}));
    EXPECT_EQ(fitLens("rational_polynomial", {0, 0, 0, 0, 0, 0, 0, 0}, camera), 0);
    EXPECT_EQ(camera.distortion, (std::array<double, 5>{}));
}

/** An Azure Kinect's color camera: its first coefficients mean little without the others. */
TEST(LensFit, aRationalLensIsFollowedWithinAFewPixels) {
    const std::vector<double> D = {0.52, -2.74, 0.0004, -0.0003, 1.59, 0.40, -2.55, 1.51};
    Camera camera = kinect_azure;
    const double worst_px = fitLens("rational_polynomial", D, camera);
    EXPECT_LT(worst_px, 5);
    EXPECT_GT(worst_px, 0) << "what is not exact is told";
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(0.9, 0.5), Eigen::Vector2d(-0.7, 0.3)}) {
        const double x = p.x(), y = p.y(), r2 = p.squaredNorm(), r4 = r2 * r2, r6 = r4 * r2;
        const double ratio =
            (1 + D[0] * r2 + D[1] * r4 + D[4] * r6) / (1 + D[5] * r2 + D[6] * r4 + D[7] * r6);
        const Eigen::Vector2d seen(x * ratio + 2 * D[2] * x * y + D[3] * (r2 + 2 * x * x),
                                   y * ratio + D[2] * (r2 + 2 * y * y) + 2 * D[3] * x * y);
        const Eigen::Vector2d ours = camera.distort(camera.project({x, y, 1}));
        const Eigen::Vector2d truth(camera.fx * seen.x() + camera.cx,
                                    camera.fy * seen.y() + camera.cy);
        EXPECT_LT((ours - truth).norm(), worst_px + 1e-6);
    }
}

TEST(LensFit, anUnknownLensHasNone) {
    Camera camera;
    camera.distortion[0] = 1;
    EXPECT_TRUE(std::isinf(fitLens("omnidirectional", {1, 2, 3, 4, 5, 6}, camera)));
    EXPECT_EQ(camera.distortion, (std::array<double, 5>{}));
}

TEST(LensFit, aFisheyeIsBentTheRightWayAndItsErrorTold) {
    Camera camera{640, 480, 320, 320, 320, 240, {}};
    EXPECT_GT(fitLens("equidistant", {0.01, -0.002, 0, 0}, camera), 1);
    EXPECT_LT(camera.distortion[0], -0.1) << "barrel";
}

}  // namespace
}  // namespace rgbd_graphslam
