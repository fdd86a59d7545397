/** Points with descriptors and cameras that see them: frames whose truth is exact. */
#pragma once
#include <cmath>
#include <random>
#include <vector>

#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** The walls of a box-shaped room, sown with points. */
class SyntheticWorld {
  public:
    explicit SyntheticWorld(int points = 12000, std::uint64_t seed = 1) : random_(seed) {
        for (int i = 0; i < points; ++i) {
            Eigen::Vector3d p(uniform(-3, 3), uniform(-1.5, 1.5), uniform(-3, 3));
            const int wall = i % 4;
            if (wall == 0) p.x() = -3 + 0.2 * uniform(0, 1);
            if (wall == 1) p.x() = 3 - 0.2 * uniform(0, 1);
            if (wall == 2) p.z() = -3 + 0.2 * uniform(0, 1);
            if (wall == 3) p.z() = 3 - 0.2 * uniform(0, 1);
            points_.push_back(p);
            descriptors_.push_back({random_(), random_(), random_(), random_()});
        }
    }

    /** A wall 3 m ahead along x whose every `period_m` looks the same. */
    static SyntheticWorld repeatingWall(double period_m, int periods) {
        SyntheticWorld wall(0);
        for (int i = 0; i < 150 * period_m; ++i) {
            const Eigen::Vector3d p(wall.uniform(0, period_m), wall.uniform(-1.5, 1.5),
                                    wall.uniform(2.9, 3.1));
            const Descriptor look{wall.random_(), wall.random_(), wall.random_(), wall.random_()};
            for (int n = 0; n < periods; ++n) {
                wall.points_.push_back(p + Eigen::Vector3d(n * period_m, 0, 0));
                wall.descriptors_.push_back(look);
            }
        }
        return wall;
    }

    /** \param noise_px of keypoint places; depth has a tenth of a percent; every descriptor has a
     * few flipped bits */
    Frame view(const SE3& T_world_cam, double stamp_s, const Camera& camera,
               double noise_px = 0.3) {
        const SE3 T_cam_world = T_world_cam.inverse();
        Frame frame;
        frame.stamp_s = stamp_s;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::Vector3d p = T_cam_world * points_[i];
            if (p.z() < 0.3 || p.z() > 8) continue;
            const Eigen::Vector2d pixel = camera.project(p);
            if (!camera.contains(pixel)) continue;
            Keypoint k;
            k.u = static_cast<float>(pixel.x() + noise_px * gauss());
            k.v = static_cast<float>(pixel.y() + noise_px * gauss());
            k.depth_m = static_cast<float>(p.z() * (1 + 0.001 * gauss()));
            frame.keypoints.push_back(k);
            frame.descriptors.push_back(withFlippedBits(descriptors_[i]));
            if (frame.keypoints.size() == 1200) break;
        }
        frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
        return frame;
    }

    double uniform(double from, double to) {
        return from + (to - from) * (random_() >> 11) * 0x1p-53;
    }

    /** Sum of twelve uniforms: near enough to a normal distribution, the same on every machine. */
    double gauss() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += uniform(0, 1);
        return sum;
    }

  private:
    Descriptor withFlippedBits(Descriptor descriptor) {
        for (int i = 0; i < 8; ++i)
            descriptor[random_() % 4] ^= std::uint64_t{1} << (random_() % 64);
        return descriptor;
    }

    std::mt19937_64 random_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<Descriptor> descriptors_;
};

/** On a circle of radius 1 m, looking outwards; `turn` in rad. */
inline SE3 onCircle(double turn) {
    const Eigen::Matrix3d R = rotationExp({0, turn, 0});
    return {R, R * Eigen::Vector3d(0, 0, 1)};
}

}  // namespace rgbd_graphslam
