#include "rgbd_graphslam/viewer/snapshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/scene_colors.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class Snapshot : public testing::Test {
  protected:
    Snapshot() { fs::create_directories(folder_); }
    ~Snapshot() override { fs::remove_all(folder_); }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    /** A square meter of one color at a height. */
    static PointMap sheet(float z, std::array<std::uint8_t, 3> rgb) {
        PointMap points;
        for (float x = -0.5f; x < 0.5f; x += 0.01f) {
            for (float y = -0.5f; y < 0.5f; y += 0.01f) points.push_back({{x, y, z}, rgb});
        }
        return points;
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("rgbd-snapshot-" + std::to_string(getpid()));
};

int pixelsLike(const cv::Mat3b& image, const cv::Vec3b& bgr) {
    int count = 0;
    for (const auto& pixel : image) {
        count += cv::norm(cv::Vec3i(pixel) - cv::Vec3i(bgr), cv::NORM_INF) < 30;
    }
    return count;
}

TEST_F(Snapshot, showsTheFloorThroughTheCeilingUnlessToldNotTo) {
    PointMap points = sheet(0, {200, 30, 20});
    const PointMap ceiling = sheet(2.5f, {20, 30, 200});
    points.insert(points.end(), ceiling.begin(), ceiling.end());
    const auto scene = makeScene(MapInputs(), points, CameraModel());
    ViewOptions view;
    view.width_px = 320, view.height_px = 240, view.elevation_deg = 89;
    renderSnapshot(scene, view, path("a.png"));
    const cv::Mat3b open = cv::imread(path("a.png"));
    ASSERT_EQ(open.size(), cv::Size(320, 240));
    EXPECT_GT(pixelsLike(open, {20, 30, 200}), 5000);
    EXPECT_EQ(pixelsLike(open, {200, 30, 20}), 0);
    view.cut_ceiling = false;
    renderSnapshot(scene, view, path("b.png"));
    EXPECT_GT(pixelsLike(cv::imread(path("b.png")), {200, 30, 20}), 1000);
}

TEST_F(Snapshot, meshTakesThePlaceOfThePoints) {
    PlyModel mesh;
    mesh.vertices = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
    mesh.colors.assign(4, {20, 200, 30});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    ViewOptions view;
    view.width_px = 320, view.height_px = 240, view.elevation_deg = 89;
    const auto scene = makeScene(MapInputs(), sheet(0, {200, 30, 20}), CameraModel());
    renderSnapshot(scene, view, path("a.png"), mesh);
    const cv::Mat3b image = cv::imread(path("a.png"));
    EXPECT_GT(pixelsLike(image, {30, 200, 20}), 5000);
    EXPECT_EQ(pixelsLike(image, {20, 30, 200}), 0);
    for (auto& vertex : mesh.vertices) vertex.z() = 2.5f;  // above people's heads
    renderSnapshot(scene, view, path("a.png"), mesh);
    EXPECT_EQ(pixelsLike(cv::imread(path("a.png")), {30, 200, 20}), 0);
}

TEST_F(Snapshot, pathsAreSeen) {
    MapInputs inputs;
    for (int i = 0; i < 20; ++i)
        inputs.trajectory.push_back(
            {0.1 * i, SE3(Eigen::Matrix3d::Identity(), {0.05 * i - 0.5, 0, 1})});
    inputs.keyframes = {inputs.trajectory.front(), inputs.trajectory.back()};
    inputs.loops = {{0, 1, 9}};
    ViewOptions view;
    view.width_px = 320, view.height_px = 240;
    renderSnapshot(makeScene(inputs, sheet(0, {200, 200, 200}), CameraModel()), view,
                   path("a.png"));
    const cv::Mat3b image = cv::imread(path("a.png"));
    const auto bgr = [](const Rgba& color) { return cv::Vec3b(color[2], color[1], color[0]); };
    EXPECT_GT(pixelsLike(image, bgr(keyframe_color)), 20);
    EXPECT_GT(pixelsLike(image, bgr(loop_color)), 20);  // over the straight trajectory
    EXPECT_GT(pixelsLike(image, bgr(background_color)), 5000);
}

TEST_F(Snapshot, aFewStrayPointsDoNotMakeTheMapSmall) {
    PointMap points = sheet(0, {200, 30, 20});
    ViewOptions view;
    view.width_px = 320, view.height_px = 240, view.elevation_deg = 89;
    renderSnapshot(makeScene(MapInputs(), points, CameraModel()), view, path("a.png"));
    const int without = pixelsLike(cv::imread(path("a.png")), {20, 30, 200});
    for (int i = 0; i < 100; ++i) points.push_back({{30, 0.01f * static_cast<float>(i), 0}, {}});
    renderSnapshot(makeScene(MapInputs(), points, CameraModel()), view, path("b.png"));
    EXPECT_GT(pixelsLike(cv::imread(path("b.png")), {20, 30, 200}), 0.9 * without);
}

TEST_F(Snapshot, sceneFilesThatAreNoScenesAreRefused) {
    const auto problem = [&](const std::string& file) {
        try {
            loadScene(file);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    saveMrptObject(path("a.3Dscene"), makeScene(MapInputs(), sheet(0, {1, 2, 3}), Camera()));
    EXPECT_EQ(problem(path("a.3Dscene")), "");
    for (const double share : {0.0, 0.2, 0.9}) {
        saveMrptObject(path("a.3Dscene"), makeScene(MapInputs(), sheet(0, {1, 2, 3}), Camera()));
        fs::resize_file(path("a.3Dscene"),
                        static_cast<std::uintmax_t>(
                            share * static_cast<double>(fs::file_size(path("a.3Dscene")))));
        EXPECT_THAT(problem(path("a.3Dscene")), testing::HasSubstr("a.3Dscene")) << share;
    }
    EXPECT_THAT(problem(path("none.3Dscene")), testing::HasSubstr("none.3Dscene"));
}

}  // namespace
}  // namespace rgbd_graphslam
