/** Walls in the plane, and what a robot with a laser scanner and wheels measures among them. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>
#include <limits>
#include <vector>

#include "random_inputs.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/laser/planar_scan.h"

namespace rgbd_graphslam {

struct Wall {
    Eigen::Vector2d from, to;
};

class FloorPlan {
  public:
    /** Four walls. */
    void addBox(double x0, double y0, double x1, double y1) {
        const Eigen::Vector2d a(x0, y0), b(x1, y0), c(x1, y1), d(x0, y1);
        for (const Wall& wall : {Wall{a, b}, Wall{b, c}, Wall{c, d}, Wall{d, a}}) {
            walls.push_back(wall);
        }
    }

    /** Distance to the nearest wall; infinite where there is none. */
    double range(const Eigen::Vector2d& origin, double angle) const {
        const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
        double nearest = std::numeric_limits<double>::infinity();
        for (const Wall& wall : walls) {
            const Eigen::Vector2d along = wall.to - wall.from, off = wall.from - origin;
            const double cross = ray.x() * along.y() - ray.y() * along.x();
            if (std::abs(cross) < 1e-12) continue;
            const double t = (off.x() * along.y() - off.y() * along.x()) / cross;
            const double s = (off.x() * ray.y() - off.y() * ray.x()) / cross;
            if (t > 0 && s >= 0 && s <= 1) nearest = std::min(nearest, t);
        }
        return nearest;
    }

    std::vector<Wall> walls;
};

/** A ring of corridors, 2 m wide, around a block with niches that all differ. */
inline FloorPlan ringOfCorridors() {
    FloorPlan plan;
    plan.addBox(0, 0, 20, 14);
    plan.addBox(2, 2, 18, 12);
    const double niches[][2] = {{3, 0}, {7.5, 0}, {13, 0}, {15.2, 0}};
    for (const auto& niche : niches) {
        plan.addBox(niche[0], 0, niche[0] + 0.6, 0.35);
        plan.addBox(19 - niche[0], 13.6, 19.3 - niche[0], 14);
    }
    plan.addBox(19.5, 4, 20, 4.6);
    plan.addBox(19.6, 9, 20, 10);
    plan.addBox(0, 6, 0.3, 6.9);
    plan.addBox(0, 9.5, 0.5, 9.8);
    return plan;
}

/** 270 degrees with `beams` beams and `sigma_m` of noise. */
inline mrpt::obs::CObservation2DRangeScan::Ptr scanOf(const FloorPlan& plan,
                                                      const PlanarPose& T_world_base,
                                                      double stamp_s, RandomInputs& random,
                                                      double sigma_m = 0.01,
                                                      std::size_t beams = 271) {
    constexpr double max_range_m = 25;
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->sensorLabel = "LASER";
    scan->timestamp = toMrptTime(stamp_s);
    scan->aperture = static_cast<float>(1.5 * M_PI);
    scan->rightToLeft = true;
    scan->maxRange = max_range_m;
    scan->sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.3, 0, 0, 0);
    const Eigen::Vector2d origin = transformed(T_world_base, Eigen::Vector2d(0.2, 0));
    scan->resizeScan(beams);
    for (std::size_t i = 0; i < beams; ++i) {
        const double angle =
            -0.75 * M_PI + 1.5 * M_PI * static_cast<double>(i) / static_cast<double>(beams - 1);
        const double range =
            plan.range(origin, T_world_base.yaw + angle) + sigma_m * random.gauss();
        const bool valid = range < max_range_m;
        scan->setScanRange(i, static_cast<float>(valid ? range : max_range_m));
        scan->setScanRangeValidity(i, valid);
    }
    return scan;
}

/** Poses at 10 Hz: straight ways between the corners and turns on the spot, 0.5 m/s, 1 rad/s. */
inline std::vector<PlanarPose> driveAlong(const std::vector<Eigen::Vector2d>& corners) {
    constexpr double step_m = 0.05, step_rad = 0.1;
    std::vector<PlanarPose> poses;
    double yaw = std::atan2(corners[1].y() - corners[0].y(), corners[1].x() - corners[0].x());
    for (std::size_t c = 0; c + 1 < corners.size(); ++c) {
        const Eigen::Vector2d along = corners[c + 1] - corners[c];
        const double heading = std::atan2(along.y(), along.x());
        const double turn = wrapped(heading - yaw);
        const int turns = static_cast<int>(std::ceil(std::abs(turn) / step_rad));
        for (int i = 1; i <= turns; ++i) {
            poses.push_back({corners[c].x(), corners[c].y(), wrapped(yaw + turn * i / turns)});
        }
        yaw = heading;
        const int steps = static_cast<int>(std::ceil(along.norm() / step_m));
        for (int i = 0; i < steps; ++i) {
            const Eigen::Vector2d p = corners[c] + along * i / steps;
            poses.push_back({p.x(), p.y(), yaw});
        }
    }
    return poses;
}

/** Corners of `rounds` rounds in ringOfCorridors(). */
inline std::vector<Eigen::Vector2d> roundsInRing(int rounds) {
    std::vector<Eigen::Vector2d> corners{{1, 1}};
    for (int i = 0; i < rounds; ++i) {
        corners.push_back({19, 1});
        corners.push_back({19, 13});
        corners.push_back({1, 13});
        corners.push_back({1, 1});
    }
    corners.push_back({6, 1});
    return corners;
}

/** What wheels of wrong size tell: ways `scale` times as long, turns `yaw_scale` times as far, and
 *  noise. */
inline std::vector<PlanarPose> odometryOf(const std::vector<PlanarPose>& truth, double scale,
                                          double yaw_scale, RandomInputs& random) {
    std::vector<PlanarPose> odometry{{}};
    for (std::size_t i = 1; i < truth.size(); ++i) {
        PlanarPose step = truth[i - 1].inverse() * truth[i];
        step.x *= scale + 0.02 * random.gauss();
        step.yaw = step.yaw * yaw_scale + 0.001 * random.gauss();
        odometry.push_back(odometry.back() * step);
    }
    return odometry;
}

}  // namespace rgbd_graphslam
