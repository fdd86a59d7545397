#include "rgbd_graphslam/mapping/upright.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "rgbd_graphslam/mapping/level_scan.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t fewest_readings = 10;
constexpr double least_agreement = 0.9;  // length of the mean of unit vectors
constexpr double gravity = 9.81, gravity_tolerance = 3;

constexpr int patch_step_px = 12, patch_arm_px = 4;
constexpr std::size_t fewest_patches = 200;
constexpr double least_level_share = 0.03;

constexpr double level_cos = 0.97;  // 14 degrees
constexpr double bin_m = 0.02;
constexpr double least_of_largest = 0.15;  // a floor may show less than a table does

double degrees(double angle) {
    return angle * M_PI / 180;
}

/** A depth image and where its pixels look. */
struct Rays {
    const cv::Mat1f& depth;
    const RayTable& table;
    double max_range_m;
};

std::optional<Eigen::Vector3d> pointAt(const Rays& rays, int u, int v) {
    const float z = rays.depth(v, u);
    if (z <= 0 || z > rays.max_range_m) return std::nullopt;
    const Eigen::Vector2f& ray = rays.table.row(v)[u];
    return Eigen::Vector3d(ray.x() * z, ray.y() * z, z);
}

/** Plane through the ends of a cross. */
std::optional<SurfacePatch> patchAt(const Rays& rays, int u, int v) {
    const auto left = pointAt(rays, u - patch_arm_px, v),
               right = pointAt(rays, u + patch_arm_px, v);
    const auto above = pointAt(rays, u, v - patch_arm_px),
               below = pointAt(rays, u, v + patch_arm_px);
    const auto middle = pointAt(rays, u, v);
    if (!left || !right || !above || !below || !middle) return std::nullopt;
    const Eigen::Vector3d normal = (*below - *above).cross(*right - *left).normalized();
    // On an edge the middle does not lie between the ends.
    const double bend = std::max(std::abs(normal.dot(0.5 * (*left + *right) - *middle)),
                                 std::abs(normal.dot(0.5 * (*above + *below) - *middle)));
    if (!(bend < 0.005 + 0.005 * middle->z() * middle->z())) return std::nullopt;
    return SurfacePatch{*middle, normal.dot(*middle) > 0 ? Eigen::Vector3d(-normal) : normal};
}

std::vector<const SurfacePatch*> within(const std::vector<SurfacePatch>& patches,
                                        const Eigen::Vector3d& up, double angle) {
    std::vector<const SurfacePatch*> found;
    for (const auto& patch : patches) {
        if (patch.normal.dot(up) > std::cos(angle)) found.push_back(&patch);
    }
    return found;
}

Eigen::Vector3d meanNormal(const std::vector<const SurfacePatch*>& patches) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto* patch : patches) sum += patch->normal;
    return sum.normalized();
}

/** The normal with most others within a few degrees, looked for among a fixed number of them. */
Eigen::Vector3d densest(const std::vector<const SurfacePatch*>& patches) {
    constexpr std::size_t candidates = 200;
    const double near = std::cos(degrees(5));
    const std::size_t step = std::max<std::size_t>(1, patches.size() / candidates);
    std::size_t best_count = 0;
    Eigen::Vector3d best = patches.front()->normal;
    for (std::size_t i = 0; i < patches.size(); i += step) {
        const Eigen::Vector3d& normal = patches[i]->normal;
        const auto count = static_cast<std::size_t>(
            std::count_if(patches.begin(), patches.end(),
                          [&](const auto* other) { return other->normal.dot(normal) > near; }));
        if (count > best_count) {
            best_count = count;
            best = normal;
        }
    }
    return best;
}

/** Of the level patches in a bin and the ones beside it. */
double medianHeight(const std::vector<SurfacePatch>& patches, const Eigen::Vector3d& up, int bin) {
    std::vector<double> heights;
    for (const auto& patch : patches) {
        const double height = patch.position.dot(up);
        const bool near = std::abs(height / bin_m - (bin + 0.5)) <= 1.5;
        if (near && patch.normal.dot(up) >= level_cos) heights.push_back(height);
    }
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return *middle;
}

}  // namespace

std::optional<Eigen::Vector3d> upFromAccelerometer(const std::vector<SpecificForce>& readings,
                                                   const Trajectory& trajectory) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), directions = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (const auto& reading : readings) {
        const auto T = poseAt(trajectory, reading.stamp_s);
        if (!T || !reading.in_camera.allFinite()) continue;
        const Eigen::Vector3d force = T->R * reading.in_camera;
        sum += force;
        directions += force.normalized();
        ++count;
    }
    if (count < fewest_readings) return std::nullopt;
    const auto n = static_cast<double>(count);
    if (directions.norm() / n < least_agreement) return std::nullopt;
    if (std::abs(sum.norm() / n - gravity) > gravity_tolerance) return std::nullopt;
    return sum.normalized();
}

std::vector<SurfacePatch> surfacePatches(const cv::Mat1f& depth, const RayTable& rays,
                                         double max_range_m) {
    const Rays readings{depth, rays, max_range_m};
    std::vector<SurfacePatch> patches;
    for (int v = patch_arm_px; v < depth.rows - patch_arm_px; v += patch_step_px) {
        for (int u = patch_arm_px; u < depth.cols - patch_arm_px; u += patch_step_px) {
            if (const auto patch = patchAt(readings, u, v)) patches.push_back(*patch);
        }
    }
    return patches;
}

std::optional<Eigen::Vector3d> upFromFloor(const std::vector<SurfacePatch>& patches,
                                           const Eigen::Vector3d& guess, double cone) {
    const auto candidates = within(patches, guess, cone);
    if (candidates.size() < fewest_patches) return std::nullopt;
    Eigen::Vector3d up = densest(candidates);
    for (const double narrow : {10., 6., 4., 4.}) {
        up = meanNormal(within(patches, up, degrees(narrow)));
    }
    const auto level = static_cast<double>(within(patches, up, degrees(4)).size());
    if (level < least_level_share * static_cast<double>(patches.size())) return std::nullopt;
    return up;
}

std::vector<double> levelHeights(const std::vector<SurfacePatch>& patches,
                                 const Eigen::Vector3d& up) {
    std::map<int, int> histogram;
    for (const auto& patch : patches) {
        if (patch.normal.dot(up) < level_cos) continue;
        ++histogram[static_cast<int>(std::floor(patch.position.dot(up) / bin_m))];
    }
    // A surface on a bin's boundary fills two, so three are taken together.
    const auto around = [&](int bin) {
        int count = 0;
        for (int b = bin - 1; b <= bin + 1; ++b) {
            const auto found = histogram.find(b);
            if (found != histogram.end()) count += found->second;
        }
        return count;
    };
    int largest = 0;
    for (const auto& entry : histogram) largest = std::max(largest, around(entry.first));
    // Of filled bins only: the one with the largest sum is among them, so one is always found. What
    // falls off above a surface's own bin belongs to it.
    std::vector<double> heights;
    bool rising = true;
    int before = 0;
    for (const auto& entry : histogram) {
        const int here = around(entry.first);
        const int next = histogram.count(entry.first + 1) ? around(entry.first + 1) : 0;
        if (!histogram.count(entry.first - 1) || here > before) rising = true;
        if (rising && here >= std::max<double>(least_of_largest * largest, next)) {
            heights.push_back(medianHeight(patches, up, entry.first));
            rising = false;
        }
        before = here;
    }
    return heights;
}

SE3 uprightFrame(const Eigen::Vector3d& up, double floor_m, const SE3& T_world_first) {
    const Eigen::Matrix3d R =
        Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const SE3 level(R, {0, 0, -floor_m});
    // Its heading and place on the floor are taken away.
    return basePose(level * T_world_first).inverse() * level;
}

}  // namespace rgbd_graphslam
