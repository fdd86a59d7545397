/** A furnished room whose depth images and surface are known exactly. */
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam::testing_room {

struct Box {
    Eigen::Vector3d low, high;
    cv::Vec3b bgr;
    bool holds(const Eigen::Vector3d& p, double margin = 0) const {
        return (p.array() > low.array() + margin).all() &&
               (p.array() < high.array() - margin).all();
    }
};

/** Floor at z = 0, z up. Everything solid is a box, but for the room itself, which is seen from
 *  inside. */
struct BoxRoom {
    Box walls{{-3, -2, 0}, {3, 2, 2.4}, {180, 200, 210}};
    std::vector<Box> furniture{
        {{1.2, -0.6, 0}, {2.0, 0.6, 0.74}, {40, 60, 200}},      // table, red
        {{-0.4, 1.3, 0}, {0.4, 2.0, 1.8}, {60, 180, 60}},       // cupboard, green
        {{-2.2, -1.4, 0}, {-1.8, -1.0, 0.45}, {200, 80, 30}}};  // stool, blue

    struct Hit {
        double distance = std::numeric_limits<double>::infinity();
        cv::Vec3b bgr;
    };

    /** First surface along origin + distance * direction. */
    Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
        Hit hit{span(walls, origin, direction).second, walls.bgr};
        for (const Box& box : furniture) {
            const auto [enter, leave] = span(box, origin, direction);
            if (enter > 0 && enter < leave && enter < hit.distance) hit = {enter, box.bgr};
        }
        return hit;
    }

    bool isFree(const Eigen::Vector3d& p, double margin) const {
        if (!walls.holds(p, margin)) return false;
        return std::none_of(furniture.begin(), furniture.end(),
                            [&](const Box& box) { return box.holds(p, -margin); });
    }

    double distanceToSurface(const Eigen::Vector3d& p) const {
        double nearest = std::abs(signedDistance(walls, p));
        for (const Box& box : furniture)
            nearest = std::min(nearest, std::abs(signedDistance(box, p)));
        return nearest;
    }

  private:
    static std::pair<double, double> span(const Box& box, const Eigen::Vector3d& o,
                                          const Eigen::Vector3d& d) {
        const Eigen::Array3d a = (box.low - o).array() / d.array(),
                             b = (box.high - o).array() / d.array();
        return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
    }
    static double signedDistance(const Box& box, const Eigen::Vector3d& p) {
        const Eigen::Array3d outside = (box.low - p).array().max((p - box.high).array());
        return outside.maxCoeff() > 0 ? outside.max(0).matrix().norm() : outside.maxCoeff();
    }
};

/** Normal deviates from a generator of our own (sum of twelve uniforms), the same everywhere. */
class Noise {
  public:
    double operator()() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) {
            state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
            sum += static_cast<double>(state_ >> 11) * 0x1p-53;
        }
        return sum;
    }

  private:
    std::uint64_t state_ = 1;
};

inline CameraModel smallCamera() {
    Intrinsics camera;
    camera.width = 320, camera.height = 240;
    camera.fx = camera.fy = 262.5, camera.cx = 159.5, camera.cy = 119.5;
    return camera;
}

/** \param noise adds DepthNoise to every reading when given */
inline RgbdImage render(const BoxRoom& room, const CameraModel& camera, const SE3& T_world_cam,
                        double stamp_s = 0, Noise* noise = nullptr) {
    RgbdImage image;
    image.stamp_s = stamp_s;
    image.depth_unit_m = 0.0002;
    image.depth = cv::Mat(camera.height, camera.width, CV_16UC1);
    image.color = cv::Mat(camera.height, camera.width, CV_8UC3);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const auto hit = room.cast(T_world_cam.t, T_world_cam.R * camera.unproject(u, v, 1));
            const double z =
                hit.distance + (noise ? DepthNoise().sigma(hit.distance) * (*noise)() : 0);
            image.depth.at<std::uint16_t>(v, u) =
                static_cast<std::uint16_t>(std::lround(z / image.depth_unit_m));
            image.color.at<cv::Vec3b>(v, u) = hit.bgr;
        }
    }
    return image;
}

/** \param yaw about z from +x, \param down below the horizon, rad */
inline SE3 lookingAlong(const Eigen::Vector3d& position, double yaw, double down) {
    const Eigen::Vector3d forward(std::cos(yaw) * std::cos(down), std::sin(yaw) * std::cos(down),
                                  -std::sin(down));
    const Eigen::Vector3d right(std::sin(yaw), -std::cos(yaw), 0);
    SE3 T;
    T.R << right, forward.cross(right), forward;
    T.t = position;
    return T;
}

/** A walk around the room's middle that sees all of it. */
inline std::vector<SE3> walk(int views) {
    std::vector<SE3> poses;
    for (int i = 0; i < views; ++i) {
        const double angle = 2 * M_PI * i / views;
        const Eigen::Vector3d position(-0.8 * std::cos(angle), -0.4 * std::sin(angle),
                                       1.2 + 0.1 * std::sin(3 * angle));
        poses.push_back(lookingAlong(position, angle, i % 2 ? 0.6 : 0.1));
    }
    return poses;
}

}  // namespace rgbd_graphslam::testing_room
