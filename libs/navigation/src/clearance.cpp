#include "rgbd_graphslam/navigation/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "rgbd_graphslam/geometry/surface_sampling.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {
namespace {
constexpr double sample_spacing_m = 0.01;
}

TrueObstacles::TrueObstacles(const PlyModel& surface, const RobotBody& body,
                             double body_clearance_m) {
    for (const BodyLevel& level : body) {
        slabs_.push_back({level.outline, circumscribedRadius({level}), {}});
    }
    std::vector<std::unordered_set<std::uint64_t>> taken(body.size());
    forEachSurfaceSample(surface, sample_spacing_m, [&](const Eigen::Vector3d& p, double) {
        const Eigen::Array2i cell = (p.head<2>() / sample_spacing_m).array().floor().cast<int>();
        for (std::size_t k = 0; k < body.size(); ++k) {
            const double low = std::max(body[k].low_m, body_clearance_m);
            if (p.z() < low || p.z() > body[k].high_m) continue;
            if (taken[k].insert(voxelKey({cell.x(), cell.y(), 0})).second)
                slabs_[k].points.push_back(p.head<2>().cast<float>());
        }
    });
}

double TrueObstacles::clearance(const mrpt::math::TPose2D& pose) const {
    const Eigen::Rotation2Dd R_robot_world(-pose.phi);
    const Eigen::Vector2d center(pose.x, pose.y);
    double least = std::numeric_limits<double>::infinity();
    for (const Slab& slab : slabs_) {
        for (const Eigen::Vector2f& point : slab.points) {
            const Eigen::Vector2d p = point.cast<double>() - center;
            if (p.norm() - slab.radius_m >= least) continue;
            least = std::min(least, signedDistance(slab.outline, R_robot_world * p));
        }
    }
    return least;
}

mrpt::math::TPose2D inTruth(const SE3& T_truth_map, const mrpt::math::TPose2D& pose) {
    const Eigen::Vector3d p = T_truth_map * Eigen::Vector3d(pose.x, pose.y, 0);
    const Eigen::Vector3d forward =
        T_truth_map.R * Eigen::Vector3d(std::cos(pose.phi), std::sin(pose.phi), 0);
    return {p.x(), p.y(), std::atan2(forward.y(), forward.x())};
}

}  // namespace rgbd_graphslam
