#include "rgbd_graphslam/synth/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/synth/motion.h"
#include "rgbd_graphslam/synth/sequence.h"
#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** A picture of about 1 cm a texel on a square of 20 m in the plane x = 4, tilted about z. */
Scene tiltedWall(double tilt_rad) {
    Scene scene;
    Random random(3);
    const cv::Mat noise = fractalNoise({2048, 2048}, {64, 64}, 4, 0.8, random);
    cv::Mat gray, picture;
    noise.convertTo(gray, CV_8UC1, 200, 128);
    cv::cvtColor(gray, picture, cv::COLOR_GRAY2BGR);
    const SE3 frame = standing(4, 0, 1, std::acos(-1.0) + tilt_rad);
    addRectangle(scene, scene.quads, frame * SE3(Eigen::Matrix3d::Identity(), {0, -10, -10}), 20,
                 20, {scene.addMaterial(picture)});
    scene.ambient = 1;
    return scene;
}

/** Depth of a pixel's ray where it meets the plane of a quad. */
double planeDepth(const Quad& quad, const CameraModel& camera, const SE3& T_world_cam, int u,
                  int v) {
    const Vector3d ray = T_world_cam.R * camera.unproject(u, v, 1);
    const Vector3d normal = quad.normal();
    return normal.dot(quad.corners[0] - T_world_cam.t) / normal.dot(ray);
}

/** Depth of the nearest face of a scene of plane faces that a pixel's ray hits; 0 = none. */
double sceneDepth(const Scene& scene, const CameraModel& camera, const SE3& T_world_cam, int u,
                  int v) {
    double nearest = 0;
    for (const Quad& quad : scene.quads) {
        const double z = planeDepth(quad, camera, T_world_cam, u, v);
        const Vector3d point = T_world_cam * camera.unproject(u, v, z);
        bool inside = z > 0;
        for (int i = 0; i < 4 && inside; ++i) {
            const Vector3d edge = quad.corners[(i + 1) % 4] - quad.corners[i];
            inside = edge.cross(point - quad.corners[i]).dot(quad.normal()) >= 0;
        }
        if (inside && (nearest == 0 || z < nearest)) nearest = z;
    }
    return nearest;
}

TEST(Renderer, DepthOfASlantedPlaneIsExact) {
    const Scene scene = tiltedWall(0.5);
    const CameraModel camera;
    const SE3 pose = lookingAt({0.2, 0.3, 1.1}, {4, 0.1, 0.9});
    const cv::Mat depth = Renderer(scene, camera).depth(pose);
    double worst = 0;
    for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u)
            worst = std::max(worst, std::abs(depth.at<float>(v, u) -
                                             planeDepth(scene.quads[0], camera, pose, u, v)));
    EXPECT_LT(worst, 5e-5);
}

TEST(Renderer, DepthOfABoxIsExactButForItsRim) {
    Scene scene = tiltedWall(0);
    addBox(scene, scene.quads, standing(2, 0.1, 0.5, 0.4), {0.5, 0.7, 0.8}, BoxSkin(Skin{0}));
    const CameraModel camera;
    const SE3 pose = lookingAt({0.1, 0.2, 1.6}, {2, 0, 0.9});
    const cv::Mat depth = Renderer(scene, camera).depth(pose);
    int off = 0;
    for (int v = 0; v < camera.height; ++v)
        for (int u = 0; u < camera.width; ++u)
            off += std::abs(depth.at<float>(v, u) - sceneDepth(scene, camera, pose, u, v)) > 1e-3;
    EXPECT_LT(off, 60);  // pixels whose center is within rounding of the outline
}

TEST(Renderer, NothingInSightHasNoDepth) {
    const Scene scene = tiltedWall(0);
    const cv::Mat depth =
        Renderer(scene, synthCamera(160, 120)).depth(lookingAt({0, 0, 1}, {-1, 0, 1}));
    EXPECT_EQ(cv::countNonZero(depth), 0);
}

/** Where a patch of one picture is found in another, to a fraction of a pixel. */
Vector2d findPatch(const cv::Mat& from, const cv::Point& at, const cv::Mat& to,
                   const Vector2d& expected) {
    const int half = 10, search = 4;
    const cv::Mat patch = from(cv::Rect(at.x - half, at.y - half, 2 * half + 1, 2 * half + 1));
    const cv::Point corner(static_cast<int>(std::lround(expected.x())) - half - search,
                           static_cast<int>(std::lround(expected.y())) - half - search);
    cv::Mat score;
    cv::matchTemplate(
        to(cv::Rect(corner, cv::Size(2 * (half + search) + 1, 2 * (half + search) + 1))), patch,
        score, cv::TM_CCOEFF_NORMED);
    cv::Point best;
    cv::minMaxLoc(score, nullptr, nullptr, nullptr, &best);
    const auto peak = [](double left, double middle, double right) {
        return 0.5 * (left - right) / (left - 2 * middle + right);
    };
    if (best.x < 1 || best.y < 1 || best.x + 1 >= score.cols || best.y + 1 >= score.rows)
        return {1e3, 1e3};
    const auto s = [&](int dx, int dy) { return score.at<float>(best.y + dy, best.x + dx); };
    return Vector2d(corner.x + half + best.x + peak(s(-1, 0), s(0, 0), s(1, 0)),
                    corner.y + half + best.y + peak(s(0, -1), s(0, 0), s(0, 1)));
}

TEST(Renderer, TruthReprojectsWithinAThirdOfAPixel) {
    const Scene scene = tiltedWall(0.2);
    const CameraModel camera;
    Renderer renderer(scene, camera);
    const SE3 first = lookingAt({1.8, 0.1, 1.2}, {4, 0.0, 1.0});
    const SE3 second = lookingAt({1.83, 0.16, 1.17}, {4, 0.03, 1.02});
    cv::Mat from, to;
    cv::cvtColor(renderer.color(first), from, cv::COLOR_BGR2GRAY);
    cv::cvtColor(renderer.color(second), to, cv::COLOR_BGR2GRAY);
    const cv::Mat depth = renderer.depth(first);
    Vector2d mean(0, 0);
    double squares = 0;
    int count = 0;
    for (int v = 60; v < 420; v += 40)
        for (int u = 60; u < 580; u += 40, ++count) {
            const Vector3d point = first * camera.unproject(u, v, depth.at<float>(v, u));
            const Vector2d expected = camera.project(second.inverse() * point);
            const Vector2d error = findPatch(from, {u, v}, to, expected) - expected;
            mean += error;
            squares += error.squaredNorm();
        }
    EXPECT_LT((mean / count).norm(), 0.05);
    EXPECT_LT(std::sqrt(squares / count), 0.3);
}

TEST(Renderer, DepthAgreesBetweenViews) {
    const World world = findScenario("office").build(1, 1);
    const Scene scene = world.scene();
    const CameraModel camera;
    Renderer renderer(scene, camera);
    const SE3 first = world.motion.T_world_cam(2.0), second = world.motion.T_world_cam(2.2);
    const cv::Mat from = renderer.depth(first), to = renderer.depth(second);
    int seen = 0, agreeing = 0;
    for (int v = 5; v < camera.height; v += 10)
        for (int u = 5; u < camera.width; u += 10) {
            const Vector3d point =
                second.inverse() * (first * camera.unproject(u, v, from.at<float>(v, u)));
            const Vector2d pixel = camera.project(point);
            if (!camera.contains(pixel)) continue;
            ++seen;
            const double z = to.at<float>(static_cast<int>(std::lround(pixel.y())),
                                          static_cast<int>(std::lround(pixel.x())));
            agreeing += std::abs(z - point.z()) < 0.01;
        }
    EXPECT_GT(seen, 1500);
    EXPECT_GT(agreeing, 0.93 * seen);  // the rest lies at outlines and is hidden from one side
}

TEST(Renderer, FiguresMove) {
    Scene scene = tiltedWall(0);
    scene.figures.emplace_back();
    addBox(scene, scene.figures[0].quads, SE3(), {0.2, 0.4, 1}, BoxSkin(Skin{0}));
    Renderer renderer(scene, synthCamera(160, 120));
    const SE3 pose = lookingAt({0, 0, 1}, {4, 0, 1});
    renderer.placeFigure(0, standing(2, 0, 0.5, 0));
    EXPECT_NEAR(renderer.depth(pose).at<float>(60, 80), 1.9, 0.01);
    renderer.placeFigure(0, standing(2, 3, 0.5, 0));
    EXPECT_NEAR(renderer.depth(pose).at<float>(60, 80), 4.0, 0.03);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
