#include "rgbd_graphslam/slam/triangulation.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"

#include <algorithm>
#include <cmath>

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

/** F with b^T F a = 0 for undistorted pixels a and b of the same point. */
Eigen::Matrix3d fundamentalMatrix(const Camera& camera, const SE3& T_b_a) {
    Eigen::Matrix3d K_inverse;
    K_inverse << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy,
        0, 0, 1;
    return K_inverse.transpose() * skew(T_b_a.t) * T_b_a.R * K_inverse;
}

/** Squared distance of keypoint b from the epipolar line of a, in units of its variance. */
double epipolarChi2(const Eigen::Vector3d& line, const Keypoint& b, double sigma_px) {
    const double distance = line.x() * b.u + line.y() * b.v + line.z();
    return distance * distance / (line.head<2>().squaredNorm() * sigma_px * sigma_px);
}

RGBD_WITH_POPCOUNT
int matchAlongLine(const Frame& frame, const std::vector<int>& candidates,
                   const std::vector<double>& sigma_px, const Eigen::Vector3d& line, int octave,
                   const Descriptor& descriptor) {
    int best = -1, best_distance = hamming_limit + 1, second = 257;
    for (const int i : candidates) {
        const Keypoint& k = frame.keypoints[i];
        if (std::abs(k.octave - octave) > 1) continue;
        const int distance = hammingDistance(descriptor, frame.descriptors[i]);
        if (distance >= second) continue;
        if (epipolarChi2(line, k, sigma_px[k.octave]) > epipolar_chi2) continue;
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

bool fits(const Camera& camera, const SlamMap& map, const SensorOptions& sensor,
          const Keyframe& keyframe, int keypoint, const Eigen::Vector3d& position) {
    const Keypoint& k = keyframe.frame.keypoints[keypoint];
    const Measurement m = measurementOf(k, map.scaleOf(k.octave), sensor);
    const Eigen::Vector3d p = keyframe.T_cam_world * position;
    return p.z() >= nearest_depth_m && residual(camera, p, m).squaredNorm() <= chi2Limit(m);
}

}  // namespace

std::optional<Eigen::Vector3d> triangulate(const Camera& camera, const SE3& T_a_world,
                                           const SE3& T_b_world, const Eigen::Vector2d& a,
                                           const Eigen::Vector2d& b) {
    const SE3 T_world_a = T_a_world.inverse(), T_world_b = T_b_world.inverse();
    const Eigen::Vector3d ray_a = T_world_a.R * camera.unproject(a.x(), a.y(), 1).normalized();
    const Eigen::Vector3d ray_b = T_world_b.R * camera.unproject(b.x(), b.y(), 1).normalized();
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

std::vector<TriangulatedPoint> triangulateBetween(const Camera& camera, const SlamMap& map,
                                                  const SlamOptions& options, int keyframe_a,
                                                  int keyframe_b) {
    const Keyframe &a = map.keyframe(keyframe_a), &b = map.keyframe(keyframe_b);
    const Eigen::Matrix3d F = fundamentalMatrix(camera, b.T_cam_world * a.T_cam_world.inverse());
    std::vector<int> candidates = unknownKeypoints(b);
    std::vector<double> sigma_px;
    sigma_px.reserve(map.levels());
    for (int octave = 0; octave < map.levels(); ++octave) {
        sigma_px.push_back(options.sensor.keypoint_sigma_px * map.scaleOf(octave));
    }
    std::vector<TriangulatedPoint> points;
    for (const int i : unknownKeypoints(a)) {
        const Keypoint& k = a.frame.keypoints[i];
        const Eigen::Vector3d line = F * Eigen::Vector3d(k.u, k.v, 1);
        const int match =
            matchAlongLine(b.frame, candidates, sigma_px, line, k.octave, a.frame.descriptors[i]);
        if (match < 0) continue;
        const Keypoint& other = b.frame.keypoints[match];
        const auto position =
            triangulate(camera, a.T_cam_world, b.T_cam_world, {k.u, k.v}, {other.u, other.v});
        if (!position) continue;
        if (!fits(camera, map, options.sensor, a, i, *position)) continue;
        if (!fits(camera, map, options.sensor, b, match, *position)) continue;
        points.push_back({i, match, *position});
        candidates.erase(std::find(candidates.begin(), candidates.end(), match));
    }
    return points;
}

}  // namespace rgbd_graphslam
