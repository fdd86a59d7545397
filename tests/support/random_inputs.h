/** Inputs for tests of what must hold for any: the same on every machine. */
#pragma once
#include <cmath>
#include <random>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

class RandomInputs {
  public:
    explicit RandomInputs(unsigned seed) : generator_(seed) {}

    double uniform(double from, double to) {
        return from + (to - from) * (generator_() + 0.5) / 4294967296.0;
    }
    /** Normally distributed with mean 0 and standard deviation 1. */
    double gauss() {
        return std::sqrt(-2 * std::log(uniform(0, 1))) * std::cos(2 * M_PI * uniform(0, 1));
    }
    int index(int count) { return static_cast<int>(uniform(0, count)); }

    Eigen::Vector3d vector(double magnitude) {
        return {uniform(-magnitude, magnitude), uniform(-magnitude, magnitude),
                uniform(-magnitude, magnitude)};
    }
    Eigen::Vector3d direction() {
        for (;;) {
            const Eigen::Vector3d v = vector(1);
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }
    /** From 1e-12 rad to pi, as many near either end as between. */
    double angle() {
        switch (index(3)) {
            case 0:
                return std::pow(10, uniform(-12, -1));
            case 1:
                return M_PI - std::pow(10, uniform(-9, -1));
            default:
                return uniform(0.1, 3);
        }
    }
    Eigen::Vector3d rotation() { return angle() * direction(); }
    SE3 pose(double magnitude_m = 5) { return {rotationExp(rotation()), vector(magnitude_m)}; }
    Vector6d tangent(double m, double rad) {
        Vector6d delta;
        delta << vector(m), vector(rad);
        return delta;
    }
    /** Of any size, seeing 45 to 70 degrees, with a lens as they are sold: none folds the image. */
    CameraModel camera() {
        for (;;) {
            const CameraModel camera = anyCamera();
            if (camera.isInvertible()) return camera;
        }
    }

  private:
    Intrinsics anyCamera() {
        Intrinsics camera;
        camera.width = 160 + index(1200);
        camera.height = camera.width * 3 / 4;
        camera.fx = camera.width * uniform(0.7, 1.2);
        camera.fy = camera.fx * uniform(0.95, 1.05);
        camera.cx = camera.width * uniform(0.45, 0.55);
        camera.cy = camera.height * uniform(0.45, 0.55);
        const double k1 = uniform(-0.1, 0.25), k2 = uniform(-0.2, 0.1);
        const double p1 = uniform(-0.005, 0.005), p2 = uniform(-0.005, 0.005);
        camera.lens = BrownLens{{k1, k2, p1, p2, uniform(-0.05, 0.1)}};
        return camera;
    }

    std::mt19937 generator_;
};

}  // namespace rgbd_graphslam
