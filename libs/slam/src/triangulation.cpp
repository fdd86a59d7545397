#include "rgbd_graphslam/slam/triangulation.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"

#include <algorithm>
#include <cmath>

#include "epipolar_geometry.h"
#include "popcount.h"

namespace rgbd_graphslam {
namespace {

constexpr int hamming_limit = 50;
constexpr int farther_second = 10;       // bits that the second-best match must be worse by
constexpr double epipolar_chi2 = 3.841;  // 95 %, one degree of freedom
/** Rays that are nearer to parallel than this give a depth that is hardly better than none. */
constexpr double widest_parallax_cosine = 0.9998;

/** Keypoints that could become landmarks by triangulation only. */
std::vector<int> unknownKeypoints(const Keyframe& keyframe) {
    std::vector<int> unknown;
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
        const bool known =
            keyframe.landmarks[i] != no_landmark || keyframe.frame.keypoints[i].depth_m > 0;
        if (!known) unknown.push_back(static_cast<int>(i));
    }
    return unknown;
}

/** Epipolar geometry of every camera of keyframe b with one of keyframe a. */
class EpipolarSearch {
  public:
    EpipolarSearch(const RigCameras& cameras, int camera_a, const SE3& T_b_a) {
        const MountedCamera& a = cameras[camera_a];
        for (const MountedCamera& b : cameras.mounted()) {
            const SE3 T_camb_cama = b.T_cam_body() * T_b_a * a.T_cam_body().inverse();
            geometry_.emplace_back(a.camera(), b.camera(), T_camb_cama);
        }
    }
    void lookFor(const Keypoint& a) {
        lines_.clear();
        for (const EpipolarGeometry& geometry : geometry_) lines_.push_back(geometry.lineOf(a));
    }
    bool agrees(const Keypoint& b, double sigma_px) const {
        return geometry_[b.camera].chi2(lines_[b.camera], b, sigma_px) <= epipolar_chi2;
    }

  private:
    std::vector<EpipolarGeometry> geometry_;
    std::vector<Eigen::Vector3d> lines_;
};

RGBD_WITH_POPCOUNT
int matchAlongLine(const Frame& frame, const std::vector<int>& candidates,
                   const std::vector<double>& sigma_px, const EpipolarSearch& epipolar, int octave,
                   const Descriptor& descriptor) {
    int best = -1, best_distance = hamming_limit + 1, second = 257;
    for (const int i : candidates) {
        const Keypoint& k = frame.keypoints[i];
        if (std::abs(k.octave - octave) > 1) continue;
        const int distance = hammingDistance(descriptor, frame.descriptors[i]);
        if (distance >= second) continue;
        if (!epipolar.agrees(k, sigma_px[k.octave])) continue;
        if (distance < best_distance) {
            second = best_distance;
            best_distance = distance;
            best = i;
        } else {
            second = distance;
        }
    }
    return second - best_distance >= farther_second ? best : -1;
}

bool fits(const RigCameras& cameras, const SlamMap& map, const SensorOptions& sensor,
          const Keyframe& keyframe, int keypoint, const Eigen::Vector3d& position) {
    const Keypoint& k = keyframe.frame.keypoints[keypoint];
    const Measurement m = measurementOf(k, map.scaleOf(k.octave), sensor);
    return PointView(cameras[k.camera], keyframe.T_cam_world, position).fits(m);
}

}  // namespace

std::optional<Eigen::Vector3d> triangulate(const CameraModel& camera_a, const CameraModel& camera_b,
                                           const SE3& T_a_world, const SE3& T_b_world,
                                           const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const SE3 T_world_a = T_a_world.inverse(), T_world_b = T_b_world.inverse();
    const Eigen::Vector3d ray_a = T_world_a.R * camera_a.unproject(a.x(), a.y(), 1).normalized();
    const Eigen::Vector3d ray_b = T_world_b.R * camera_b.unproject(b.x(), b.y(), 1).normalized();
    const double cosine = ray_a.dot(ray_b);
    if (cosine > widest_parallax_cosine) return std::nullopt;
    const Eigen::Vector3d baseline = T_world_b.t - T_world_a.t;
    const double sine2 = 1 - cosine * cosine;
    const double along_a = (ray_a.dot(baseline) - cosine * ray_b.dot(baseline)) / sine2;
    const double along_b = (cosine * ray_a.dot(baseline) - ray_b.dot(baseline)) / sine2;
    if (along_a <= 0 || along_b <= 0) return std::nullopt;
    const Eigen::Vector3d on_a = T_world_a.t + along_a * ray_a;
    const Eigen::Vector3d on_b = T_world_b.t + along_b * ray_b;
    // The nearer camera places the point better.
    return (along_b * on_a + along_a * on_b) / (along_a + along_b);
}

std::vector<TriangulatedPoint> triangulateBetween(const RigCameras& cameras, const SlamMap& map,
                                                  const SlamOptions& options, int keyframe_a,
                                                  int keyframe_b) {
    const Keyframe &a = map.keyframe(keyframe_a), &b = map.keyframe(keyframe_b);
    std::vector<EpipolarSearch> epipolar;
    for (int camera = 0; camera < cameras.count(); ++camera) {
        epipolar.emplace_back(cameras, camera, b.T_cam_world * a.T_cam_world.inverse());
    }
    std::vector<int> candidates = unknownKeypoints(b);
    std::vector<double> sigma_px;
    sigma_px.reserve(map.levels());
    for (int octave = 0; octave < map.levels(); ++octave) {
        sigma_px.push_back(options.sensor.keypoint_sigma_px * map.scaleOf(octave));
    }
    const auto poseOf = [&](const Keyframe& keyframe, const Keypoint& k) {
        return cameras[k.camera].fromBody(keyframe.T_cam_world);
    };
    std::vector<TriangulatedPoint> points;
    for (const int i : unknownKeypoints(a)) {
        const Keypoint& k = a.frame.keypoints[i];
        epipolar[k.camera].lookFor(k);
        const int match = matchAlongLine(b.frame, candidates, sigma_px, epipolar[k.camera],
                                         k.octave, a.frame.descriptors[i]);
        if (match < 0) continue;
        const Keypoint& other = b.frame.keypoints[match];
        const auto position =
            triangulate(cameras[k.camera].camera(), cameras[other.camera].camera(), poseOf(a, k),
                        poseOf(b, other), {k.u, k.v}, {other.u, other.v});
        if (!position) continue;
        if (!fits(cameras, map, options.sensor, a, i, *position)) continue;
        if (!fits(cameras, map, options.sensor, b, match, *position)) continue;
        points.push_back({i, match, *position});
        candidates.erase(std::find(candidates.begin(), candidates.end(), match));
    }
    return points;
}

}  // namespace rgbd_graphslam
