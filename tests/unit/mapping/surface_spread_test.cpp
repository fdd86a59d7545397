#include "rgbd_graphslam/mapping/surface_spread.h"

#include <gtest/gtest.h>

#include "box_room.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

/** Keyframes of the room, each placed wrong by up to `wrong_m` along each axis. */
std::vector<SurfaceView> viewsWith(double wrong_m) {
    const RayTable rays(smallCamera());
    Noise noise, error;
    const MapOptions options;
    std::vector<SurfaceView> views;
    for (const SE3& T : walk(12)) {
        const RgbdImage image = render(BoxRoom(), smallCamera(), T, 0, &noise);
        const cv::Mat1f depth = cleanDepth(image, smallCamera(), options);
        const SE3 placed(T.R, T.t + wrong_m * Eigen::Vector3d(error(), error(), error()));
        SurfaceView& view = views.emplace_back();
        view.eye = placed.t;
        for (const SurfacePatch& patch : surfacePatches(depth, rays, options.max_range_m)) {
            view.patches.push_back({placed * patch.position, placed.R * patch.normal});
        }
    }
    return views;
}

TEST(SurfaceSpread, growsWithTheErrorOfTheKeyframes) {
    double before_m = 0;
    for (const double wrong_m : {0., 0.01, 0.03}) {
        const SurfaceSpread spread = surfaceSpread(viewsWith(wrong_m));
        EXPECT_GT(spread.surfaces, 150u);
        EXPECT_GT(spread.median_m, before_m + 0.2 * wrong_m) << wrong_m;
        EXPECT_GT(spread.p95_m, spread.median_m);
        before_m = spread.median_m;
    }
    EXPECT_LT(surfaceSpread(viewsWith(0)).median_m, 0.01);
}

TEST(SurfaceSpread, oneKeyframeHasNothingToDisagreeWith) {
    auto views = viewsWith(0);
    views.resize(1);
    EXPECT_EQ(surfaceSpread(views).surfaces, 0u);
    EXPECT_EQ(surfaceSpread({}).surfaces, 0u);
}

}  // namespace
}  // namespace rgbd_graphslam
