/** RGB-D frames of a room with textured walls, cast ray by ray, for tests that need something to
 *  track in milliseconds. */
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {

/** A box with a picture on each side; MRPT's axes, z up, floor at z = 0. */
class TexturedRoom {
  public:
    TexturedRoom() {
        cv::RNG random(7);
        for (cv::Mat& wall : walls_) {
            cv::Mat blocks(60, 60, CV_8UC3);
            random.fill(blocks, cv::RNG::UNIFORM, 20, 236);
            cv::resize(blocks, wall, {pixels_a_wall, pixels_a_wall}, 0, 0, cv::INTER_NEAREST);
            cv::GaussianBlur(wall, wall, {3, 3}, 0);
        }
        setup_.camera = Intrinsics{320, 240, 262.5, 262.5, 159.5, 119.5, {}};
        setup_.depth_units = 5000;
    }

    const CameraSetup& setup() const { return setup_; }

    /** \param T_world_base of the robot, which is the sensor here */
    mrpt::obs::CObservation3DRangeScan::Ptr film(const SE3& T_world_base, double stamp_s) const {
        const CameraModel camera = setup_.camera;
        cv::Mat color(camera.height, camera.width, CV_8UC3);
        cv::Mat depth(camera.height, camera.width, CV_16UC1);
        const SE3 T_world_cam = T_world_base * T_optical_from_mrpt.inverse();
        for (int v = 0; v < camera.height; ++v) {
            for (int u = 0; u < camera.width; ++u) {
                const Eigen::Vector3d ray = T_world_cam.R * camera.unproject(u, v, 1);
                const double z = cast(T_world_cam.t, ray, color.at<cv::Vec3b>(v, u));
                depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(z * 5000 + 0.5);
            }
        }
        return makeRgbdObservation(setup_, stamp_s, color, depth);
    }

  private:
    static constexpr int pixels_a_wall = 720;

    /** \return depth, as the ray has z = 1 in the camera */
    double cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, cv::Vec3b& color) const {
        double nearest = 1e9;
        int side = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(ray[axis]) < 1e-12) continue;
            const double wall = ray[axis] > 0 ? high_[axis] : low_[axis];
            const double distance = (wall - origin[axis]) / ray[axis];
            if (distance >= nearest) continue;
            nearest = distance;
            side = 2 * axis + (ray[axis] > 0);
        }
        color = paint(side, origin + nearest * ray);
        return nearest;
    }

    cv::Vec3b paint(int side, const Eigen::Vector3d& point) const {
        const int axis = side / 2, across = axis == 0 ? 1 : 0, along = axis == 2 ? 1 : 2;
        const auto pixel = [&](int i) {
            const double share = (point[i] - low_[i]) / (high_[i] - low_[i]);
            return std::min(pixels_a_wall - 1,
                            std::max(0, static_cast<int>(share * pixels_a_wall)));
        };
        return walls_[side].at<cv::Vec3b>(pixel(along), pixel(across));
    }

    const Eigen::Vector3d low_{-2, -2, 0}, high_{2, 2, 2.5};
    std::array<cv::Mat, 6> walls_;
    CameraSetup setup_;
};

/** A robot that goes round in the room, looking outward. \param turn_rad in each frame */
inline SE3 roundTrip(int frame, double turn_rad) {
    const double angle = frame * turn_rad;
    return {rotationExp({0, 0, angle}),
            Eigen::Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), 1.2)};
}

constexpr double room_start_s = 1700000000, room_period_s = 1.0 / 30;

/** The frames of roundTrip, with stamps at 30 Hz. */
inline std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> filmRoundTrip(int frames,
                                                                          double turn_rad) {
    const TexturedRoom room;
    std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> film;
    for (int i = 0; i < frames; ++i) {
        film.push_back(room.film(roundTrip(i, turn_rad), room_start_s + i * room_period_s));
    }
    return film;
}

}  // namespace rgbd_graphslam
