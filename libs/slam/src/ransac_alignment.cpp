#include "rgbd_graphslam/slam/ransac_alignment.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace rgbd_graphslam {
namespace {

/** Landmarks of a place seen long ago are not exact: wider than the 95 % of one measurement. */
constexpr double widening = 4.0;
constexpr double confidence = 0.999;

SE3 alignThree(const std::vector<PointMatch>& matches,
               const std::vector<Eigen::Vector3d>& points_cam, const int (&sample)[3]) {
    Eigen::Matrix3d world, cam;
    for (int i = 0; i < 3; ++i) {
        world.col(i) = matches[sample[i]].position;
        cam.col(i) = points_cam[sample[i]];
    }
    const Eigen::Matrix4d T = Eigen::umeyama(world, cam, false);
    return {orthonormalized(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>()};
}

int iterationsNeeded(double inlier_share, int most) {
    const double good_sample = std::pow(inlier_share, 3);
    if (good_sample > confidence) return 1;
    if (good_sample < 1e-6) return most;
    return std::min<int>(
        most, static_cast<int>(std::log(1 - confidence) / std::log(1 - good_sample)) + 1);
}

RansacAlignment judge(const RigCameras& cameras, const std::vector<PointMatch>& matches,
                      const SE3& T) {
    RansacAlignment result;
    result.T_cam_world = T;
    result.inlier.assign(matches.size(), false);
    for (std::size_t i = 0; i < matches.size(); ++i) {
        const PointView view(cameras[matches[i].camera], T, matches[i].position);
        const Measurement& m = matches[i].measurement;
        if (view.tooNear()) continue;
        result.inlier[i] = view.residual(m).squaredNorm() < widening * chi2Limit(m);
        result.inliers += result.inlier[i];
    }
    return result;
}

}  // namespace

std::optional<RansacAlignment> alignRobustly(const RigCameras& cameras,
                                             const std::vector<PointMatch>& matches,
                                             const std::vector<Eigen::Vector3d>& points_cam,
                                             int max_iterations, std::uint64_t seed) {
    const auto count = static_cast<std::uint64_t>(matches.size());
    if (count < 3) return std::nullopt;
    std::mt19937_64 random(seed);
    std::optional<RansacAlignment> best;
    int needed = max_iterations;
    for (int i = 0; i < needed; ++i) {
        const int sample[3] = {static_cast<int>(random() % count),
                               static_cast<int>(random() % count),
                               static_cast<int>(random() % count)};
        if (sample[0] == sample[1] || sample[0] == sample[2] || sample[1] == sample[2]) continue;
        RansacAlignment candidate =
            judge(cameras, matches, alignThree(matches, points_cam, sample));
        if (candidate.inliers < 3 || (best && candidate.inliers <= best->inliers)) continue;
        best = std::move(candidate);
        needed = iterationsNeeded(static_cast<double>(best->inliers) / count, max_iterations);
    }
    return best;
}

}  // namespace rgbd_graphslam
