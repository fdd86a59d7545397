#include "filming.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);
}  // namespace

Exposure drifting(double t) {
    Exposure exposure;
    exposure.brightness =
        1 + 0.08 * std::sin(2 * kPi * t / 11) + 0.05 * std::sin(2 * kPi * t / 4.3 + 1);
    return exposure;
}

Exposure dim(double t, double brightness) {
    Exposure exposure = drifting(t);
    exposure.brightness *= brightness;
    exposure.gain = 3;
    exposure.shutter_s = 0.02;
    return exposure;
}

Motion strollAround(const Vector3d& center, double radius_x, double radius_y, double seconds,
                    double ahead_rad, std::uint64_t seed) {
    const int count = 12;
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count, gaze = angle + ahead_rad;
        eyes.push_back(center + Vector3d(radius_x * std::cos(angle), radius_y * std::sin(angle),
                                         0.12 * std::sin(2 * angle)));
        targets.push_back(center + Vector3d(3.2 * std::cos(gaze), 2.6 * std::sin(gaze),
                                            -0.5 + 0.15 * std::cos(3 * angle)));
    }
    return handHeld({eyes, seconds / count, true}, {targets, seconds / count, true}, {}, seed);
}

Motion watchFrom(const Vector3d& eye, const Vector3d& target, const Vector3d& eye_sway,
                 const Vector3d& target_sway, std::uint64_t seed) {
    const int count = 12;
    std::vector<Vector3d> eyes, targets;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count;
        const Vector3d way(std::cos(angle), std::sin(angle), std::sin(2 * angle));
        eyes.push_back(eye + eye_sway.cwiseProduct(way));
        targets.push_back(target + target_sway.cwiseProduct(way));
    }
    return handHeld({eyes, 1.25, true}, {targets, 1.25, true}, {}, seed);
}

double easing(double t, double begin, double end) {
    return 0.5 - 0.5 * std::cos(kPi * std::clamp((t - begin) / (end - begin), 0.0, 1.0));
}

}  // namespace rgbd_graphslam::synth
