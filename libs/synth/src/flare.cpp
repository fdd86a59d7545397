#include "flare.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector2d;

struct Ghost {
    double place;  // -1: opposite to the lamp, 1: on it
    double radius, light;
    cv::Scalar tint;
};

const Ghost kGhosts[] = {{-0.9, 0.11, 260, {0.9, 1.0, 0.6}},
                         {-0.55, 0.06, 420, {0.5, 0.9, 1.0}},
                         {-0.3, 0.035, 520, {1.0, 0.8, 0.6}},
                         {0.35, 0.045, 380, {0.7, 1.0, 0.7}},
                         {0.6, 0.08, 240, {1.0, 0.7, 0.8}}};
constexpr double kGlow = 0.22, kGlowLight = 900;  // radius as a share of the width, level
constexpr double kMarkedFrom = 0.5;               // of a ghost's light

/** Of a lamp up to half a width outside of the picture. */
std::optional<Vector2d> lampPixel(const Eigen::Vector3d& lamp, const SE3& T_world_cam,
                                  const Camera& camera) {
    const Eigen::Vector3d seen = T_world_cam.inverse() * lamp;
    if (seen.z() < 0.1) return std::nullopt;
    const Vector2d pixel = camera.project(seen);
    const double margin = 0.25 * camera.width;
    if (pixel.x() < -margin || pixel.x() > camera.width + margin) return std::nullopt;
    if (pixel.y() < -margin || pixel.y() > camera.height + margin) return std::nullopt;
    return pixel;
}

Vector2d ghostPixel(const Ghost& ghost, const Vector2d& lamp, const Camera& camera) {
    const Vector2d middle = camera.fromPlane(Vector2d::Zero());
    return middle + ghost.place * (lamp - middle);
}

/** Share of a disc's light at a distance from its center: even, with a soft rim. */
double disc(double distance_px, double radius_px) {
    return 1 / (1 + std::exp((distance_px - radius_px) / (0.06 * radius_px)));
}

/** Calls work(row, column, distance) within a reach of a place. */
template <class Work>
void around(const cv::Size& size, const Vector2d& at, double reach_px, Work work) {
    const auto clamped = [](double value, int end) {
        return static_cast<int>(std::clamp(std::ceil(value), 0.0, static_cast<double>(end)));
    };
    const int last_v = clamped(at.y() + reach_px, size.height);
    const int last_u = clamped(at.x() + reach_px, size.width);
    for (int v = clamped(at.y() - reach_px, size.height); v < last_v; ++v)
        for (int u = clamped(at.x() - reach_px, size.width); u < last_u; ++u)
            work(v, u, std::hypot(u - at.x(), v - at.y()));
}
}  // namespace

void LensFlare::spoil(cv::Mat& picture, const SE3& T_world_cam, const Camera& camera) const {
    const auto add = [&](int v, int u, double light, const cv::Scalar& tint) {
        auto& pixel = picture.at<cv::Vec3f>(v, u);
        for (int i = 0; i < 3; ++i) pixel[i] += static_cast<float>(light * tint[i]);
    };
    for (const auto& lamp : lamps_) {
        const auto at = lampPixel(lamp, T_world_cam, camera);
        if (!at) continue;
        const double glow_px = kGlow * camera.width;
        around(picture.size(), *at, 3 * glow_px, [&](int v, int u, double distance) {
            add(v, u, kGlowLight * std::exp(-4 * distance / glow_px), {1, 1, 1});
        });
        for (const Ghost& ghost : kGhosts) {
            const double radius_px = ghost.radius * camera.width;
            around(picture.size(), ghostPixel(ghost, *at, camera), 1.5 * radius_px,
                   [&](int v, int u, double distance) {
                       add(v, u, ghost.light * disc(distance, radius_px), ghost.tint);
                   });
        }
    }
}

void LensFlare::mark(cv::Mat& mask, const SE3& T_world_cam, const Camera& camera) const {
    for (const auto& lamp : lamps_) {
        const auto at = lampPixel(lamp, T_world_cam, camera);
        if (!at) continue;
        for (const Ghost& ghost : kGhosts) {
            const double radius_px = ghost.radius * camera.width;
            around(mask.size(), ghostPixel(ghost, *at, camera), 1.5 * radius_px,
                   [&](int v, int u, double distance) {
                       if (disc(distance, radius_px) >= kMarkedFrom) mask.at<uchar>(v, u) = 255;
                   });
        }
    }
}

}  // namespace rgbd_graphslam::synth
