#include "lens_warp.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam::synth {
namespace {

/** Of the pinhole's pixels against the camera's, since interpolation blurs. */
constexpr double finer = 1.25;
constexpr int margin_px = 2;
/** Of the inverse depths around a point: by how much four pixels of a plane may miss it. */
constexpr float flat_share = 2e-3f;

using Box2 = Eigen::AlignedBox<double, 2>;

/** Extent of the view on the plane z = 1. */
Box2 viewOf(const CameraModel& camera) {
    Box2 view;
    const auto extend = [&](int u, int v) {
        view.extend(camera.unproject(u, v, 1).head<2>().eval());
    };
    for (int u = 0; u < camera.width; ++u) {
        for (const int v : {0, camera.height - 1}) extend(u, v);
    }
    for (int v = 0; v < camera.height; ++v) {
        for (const int u : {0, camera.width - 1}) extend(u, v);
    }
    return view;
}

CameraModel pinholeFor(const CameraModel& camera) {
    if (!camera.hasDistortion()) return camera;
    const Box2 view = viewOf(camera);
    Intrinsics pinhole;
    pinhole.fx = finer * camera.pixelsPerRadian().x();
    pinhole.fy = finer * camera.pixelsPerRadian().y();
    pinhole.cx = margin_px - pinhole.fx * view.min().x();
    pinhole.cy = margin_px - pinhole.fy * view.min().y();
    pinhole.width = static_cast<int>(std::ceil(pinhole.fx * view.sizes().x())) + 2 * margin_px;
    pinhole.height = static_cast<int>(std::ceil(pinhole.fy * view.sizes().y())) + 2 * margin_px;
    return pinhole;
}

/** Inverse depth is linear in the pixels of a plane. */
float depthBetween(const cv::Mat1f& depth, float x, float y) {
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const float a = x - static_cast<float>(i), b = y - static_cast<float>(j);
    const float nearest = depth(j + (b > 0.5f), i + (a > 0.5f));
    const float z[] = {depth(j, i), depth(j, i + 1), depth(j + 1, i), depth(j + 1, i + 1)};
    if (*std::min_element(z, z + 4) <= 0) return nearest;
    const float w[] = {1 / z[0], 1 / z[1], 1 / z[2], 1 / z[3]};
    if (std::abs(w[0] + w[3] - w[1] - w[2]) > flat_share * w[0]) return nearest;
    return 1 / ((1 - b) * ((1 - a) * w[0] + a * w[1]) + b * ((1 - a) * w[2] + a * w[3]));
}

}  // namespace

LensWarp::LensWarp(const CameraModel& camera) : pinhole_(pinholeFor(camera)) {
    if (!camera.hasDistortion()) return;
    x_.create(camera.height, camera.width);
    y_.create(camera.height, camera.width);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const Eigen::Vector2d seen = pinhole_.project(camera.unproject(u, v, 1));
            x_(v, u) = static_cast<float>(seen.x());
            y_(v, u) = static_cast<float>(seen.y());
        }
    }
}

cv::Mat LensWarp::smooth(const cv::Mat& picture) const {
    if (x_.empty()) return picture;
    cv::Mat seen;
    cv::remap(picture, seen, x_, y_, cv::INTER_LINEAR);
    return seen;
}

cv::Mat LensWarp::nearest(const cv::Mat& picture) const {
    if (x_.empty()) return picture;
    cv::Mat seen;
    cv::remap(picture, seen, x_, y_, cv::INTER_NEAREST);
    return seen;
}

cv::Mat LensWarp::depth(const cv::Mat& depth) const {
    if (x_.empty()) return depth;
    const cv::Mat1f from = depth;
    cv::Mat1f seen(x_.size());
    for (int v = 0; v < seen.rows; ++v) {
        for (int u = 0; u < seen.cols; ++u) seen(v, u) = depthBetween(from, x_(v, u), y_(v, u));
    }
    return seen;
}

}  // namespace rgbd_graphslam::synth
