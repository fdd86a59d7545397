/** A small map whose every measurement is exact. */
#pragma once
#include <random>
#include <utility>
#include <vector>

#include "rgbd_graphslam/slam/rig_cameras.h"
#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

/** Points before cameras that move sideways and turn a little; every camera sees all of them. */
class ExactMap {
  public:
    explicit ExactMap(int points = 120) {
        std::mt19937_64 random(5);
        const auto any = [&] { return (random() >> 11) * 0x1p-52 - 1; };
        for (int p = 0; p < points; ++p) {
            points_.emplace_back(0.7 * any(), 0.6 * any(), 3 + any());
            descriptors_.push_back({random(), random(), random(), random()});
        }
    }

    /** T_cam_world of view k. */
    static SE3 truth(int k) { return {rotationExp({0, 0.02 * k, 0}), {0.05 * k, 0, 0}}; }

    /** Keypoint i shows point i. */
    Frame view(const SE3& T_cam_world, double stamp_s = 0) const {
        Frame frame;
        frame.stamp_s = stamp_s;
        for (const Eigen::Vector3d& point : points_) {
            const Eigen::Vector3d p = T_cam_world * point;
            const Eigen::Vector2d pixel = camera.project(p);
            frame.keypoints.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                                       static_cast<float>(p.z()), 0, 0});
        }
        frame.descriptors = descriptors_;
        frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
        return frame;
    }

    /** A keyframe that sees every landmark there is; the first one makes them.
     *  \param T_cam_world where the map has it, wherever it truly is */
    int add(int k, const SE3& T_cam_world, Link link = Link::Tracked) {
        const bool first = map.keyframes().empty();
        const int id = map.addKeyframe(view(truth(k)), T_cam_world, 0, link);
        for (int p = 0; p < static_cast<int>(points_.size()); ++p) {
            if (first) {
                map.addLandmark(points_[p], id, p);
            } else {
                map.addObservation(p, id, p);
            }
        }
        return id;
    }
    int add(int k) { return add(k, truth(k)); }

    std::vector<int> allLandmarks() const {
        std::vector<int> all(points_.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        return all;
    }
    const std::vector<Eigen::Vector3d>& points() const { return points_; }

    const Camera camera;
    const RigCameras cameras{camera};
    SlamMap map{1.2, 8};

  private:
    std::vector<Eigen::Vector3d> points_;
    std::vector<Descriptor> descriptors_;
};

}  // namespace rgbd_graphslam
