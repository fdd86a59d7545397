#include "rgbd_graphslam/semantics/object_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rgbd_graphslam {
namespace {

const LabelSet names = {{1, {"wall", {}}}, {2, {"chair", {}}}, {3, {"box", {}}}};

/** A camera at the origin that looks along +z at a plane 2 m away. */
struct Wall {
    Camera camera;
    RayTable rays;
    MapOptions options;
    RgbdImage image;

    Wall() : camera(makeCamera()), rays(camera) {
        image.depth_unit_m = 0.001;
        image.depth = cv::Mat1w(camera.height, camera.width, std::uint16_t{2000});
        image.gray = cv::Mat1b(image.depth.size(), 128);
        image.color = cv::Mat3b(image.depth.size(), cv::Vec3b(9, 9, 9));
    }
    static Camera makeCamera() {
        Intrinsics in;
        in.width = 320, in.height = 240;
        in.fx = in.fy = 262.5;
        in.cx = 159.5, in.cy = 119.5;
        return Camera(in);
    }
    DepthView view() const { return {image, rays, options}; }
};

/** Two chairs, 0.4 m apart, before a wall, seen `frames` times; each pixel's image is wrong with a
 *  probability. */
LabelFusion fused(int frames, double wrong) {
    const Wall wall;
    std::mt19937 random(1);
    LabelFusion map(0.02);
    for (int i = 0; i < frames; ++i) {
        cv::Mat1w labels(240, 320, std::uint16_t{1});
        labels(cv::Rect(60, 80, 60, 80)) = 2;
        labels(cv::Rect(180, 80, 60, 80)) = 2;
        if (std::uniform_real_distribution<double>()(random) < wrong)
            labels = static_cast<std::uint16_t>(1 + random() % 3);
        map.insert(SE3(), wall.view(), labels);
    }
    return map;
}

double shareOf(const LabelFusion& map, int label) {
    double count = 0;
    for (const auto& entry : map.voxels().entries()) count += entry.cell.vote.best() == label;
    return count / static_cast<double>(map.voxels().entries().size());
}

TEST(LabelFusion, wrongImagesAreOutvoted) {
    const LabelFusion exact = fused(1, 0), doubtful = fused(20, 0.3);
    EXPECT_NEAR(shareOf(doubtful, 2), shareOf(exact, 2), 0.01);
    EXPECT_LT(shareOf(doubtful, 3), 0.03) << "outlines, of which right images say nothing";
}

TEST(LabelFusion, pixelsBesideOtherClassesSayNothing) {
    const Wall wall;
    cv::Mat1w stripes(240, 320, std::uint16_t{1});
    for (int u = 0; u < 320; u += 4) stripes.colRange(u, u + 2) = 2;
    LabelFusion map(0.02);
    map.insert(SE3(), wall.view(), stripes);
    EXPECT_EQ(map.voxels().entries().size(), 0u);
}

TEST(ObjectFinder, thingsAreFoundWithPlaceAndSize) {
    const FoundObjects found = findObjects(fused(3, 0), names, SemanticOptions());
    ASSERT_EQ(found.objects.size(), 2u);
    for (const MapObject& object : found.objects) {
        EXPECT_EQ(object.label, 2);
        EXPECT_GT(object.confidence, 0.9);
        // 80 x 60 pixels, less outlines of 2 px and the outermost 1 %.
        EXPECT_NEAR(object.box.size.x(), 0.57, 0.03);
        EXPECT_NEAR(object.box.size.y(), 0.42, 0.03);
        const bool is_left = object.box.center.x() < 0;
        EXPECT_NEAR(object.box.center.x(), is_left ? -0.534 : 0.380, 0.02);
        EXPECT_NEAR(object.box.center.z(), 2, 0.01);
    }
    EXPECT_LT(found.objects[0].box.center.x() * found.objects[1].box.center.x(), 0);
}

TEST(ObjectFinder, aWideGapAllowedMakesOneOfTwo) {
    SemanticOptions options;
    options.object_gap_m = 0.6;
    EXPECT_EQ(findObjects(fused(3, 0), names, options).objects.size(), 1u);
}

TEST(ObjectFinder, stuffAndWhatIsTooSmallIsNoObject) {
    SemanticOptions options;
    options.stuff_classes = "wall chair";
    EXPECT_TRUE(findObjects(fused(3, 0), names, options).objects.empty());
    options.stuff_classes = "wall";
    options.min_object_m = 1;
    EXPECT_TRUE(findObjects(fused(3, 0), names, options).objects.empty());
}

TEST(ObjectFinder, aBoxIsTurnedWithTheThing) {
    std::vector<Eigen::Vector3f> points;
    const double yaw = 0.5;
    for (double x = -1; x <= 1; x += 0.02) {
        for (double y = -0.25; y <= 0.25; y += 0.02) {
            for (const double z : {0.0, 0.4}) {
                points.emplace_back(static_cast<float>(3 + std::cos(yaw) * x - std::sin(yaw) * y),
                                    static_cast<float>(std::sin(yaw) * x + std::cos(yaw) * y),
                                    static_cast<float>(z));
            }
        }
    }
    const UprightBox box = boxAround(points);
    EXPECT_NEAR(box.yaw_rad, yaw, 0.02);
    EXPECT_NEAR((box.center - Eigen::Vector3d(3, 0, 0.2)).norm(), 0, 0.02);
    EXPECT_NEAR(box.size.x(), 2, 0.06);
    EXPECT_NEAR(box.size.y(), 0.5, 0.06);
    EXPECT_NEAR(box.size.z(), 0.4, 0.01);
}

}  // namespace
}  // namespace rgbd_graphslam
