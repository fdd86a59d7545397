#include "rgbd_graphslam/mapping/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace rgbd_graphslam {
namespace {

constexpr double low_share = 0.02, high_share = 0.98;
constexpr std::size_t most_points = 20000, most_views = 150, most_framed = 2000;
constexpr double view_cos = 0.8;  // a cone about as wide as a depth camera's image
constexpr double nearest_m = 1;   // what is nearer has no more weight

struct Weighted {
    Eigen::Vector3d position;
    double weight;
};

/** Readings on a surface fall with the square of its distance. */
double readingsOf(const Eigen::Vector3d& point, const std::vector<SE3>& views) {
    double readings = 0;
    for (const SE3& T_world_cam : views) {
        const Eigen::Vector3d ray = point - T_world_cam.t;
        const double squared = ray.squaredNorm();
        const double along = ray.dot(T_world_cam.R.col(2));
        if (along > 0 && along * along > view_cos * view_cos * squared)
            readings += 1 / std::max(squared, nearest_m * nearest_m);
    }
    return readings;
}

std::vector<SE3> someViews(const Trajectory& keyframes) {
    const std::size_t step = keyframes.size() / most_views + 1;
    std::vector<SE3> views;
    for (std::size_t k = 0; k < keyframes.size(); k += step)
        views.push_back(keyframes[k].T_world_cam);
    return views;
}

/** Points that no keyframe looks at count only where that is true of all. */
std::vector<Weighted> weighted(const PointMap& points, const Trajectory& keyframes,
                               double highest_m) {
    const std::vector<SE3> views = someViews(keyframes);
    const std::size_t step = points.size() / most_points + 1;
    std::vector<Weighted> some;
    double total = 0;
    for (std::size_t i = 0; i < points.size(); i += step) {
        const Eigen::Vector3d p = points[i].position.cast<double>();
        if (!p.allFinite() || p.z() > highest_m) continue;
        some.push_back({p, readingsOf(p, views)});
        total += some.back().weight;
    }
    if (total > 0) return some;
    for (Weighted& point : some) point.weight = 1;
    return some;
}

std::vector<Weighted> unweighted(const Trajectory& path) {
    std::vector<Weighted> poses;
    for (const StampedPose& pose : path) poses.push_back({pose.T_world_cam.t, 1});
    return poses;
}

double quantile(std::vector<std::pair<double, double>>& values, double share) {
    double total = 0, sum = 0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values) {
        sum += weight;
        if (sum >= share * total && weight > 0) return value;
    }
    return values.back().first;
}

Eigen::AlignedBox3d middleOf(const std::vector<Weighted>& points) {
    if (points.empty()) return {};
    Eigen::Vector3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<std::pair<double, double>> values;
        values.reserve(points.size());
        for (const Weighted& point : points)
            values.emplace_back(point.position[axis], point.weight);
        std::sort(values.begin(), values.end());
        low[axis] = quantile(values, low_share);
        high[axis] = quantile(values, high_share);
    }
    return {low, high};
}

/** Sorted into cubes, so that only neighbors are compared. */
class KeptKeyframes {
  public:
    KeptKeyframes(const Trajectory& keyframes, double least_m, double alike_cos)
        : keyframes_(keyframes), least_m_(least_m), alike_cos_(alike_cos) {}

    void offer(std::size_t k) {
        const Cube cube = cubeOf(k);
        if (hasLike(k, cube)) return;
        kept_in_[cube].push_back(k);
        kept_.push_back(k);
    }
    const std::vector<std::size_t>& all() const { return kept_; }

  private:
    using Cube = std::array<std::int64_t, 3>;

    Cube cubeOf(std::size_t k) const {
        const Eigen::Vector3d place = (keyframes_[k].T_world_cam.t / least_m_).array().floor();
        return {std::llround(place.x()), std::llround(place.y()), std::llround(place.z())};
    }
    bool isAlike(std::size_t a, std::size_t b) const {
        const SE3 &A = keyframes_[a].T_world_cam, &B = keyframes_[b].T_world_cam;
        return (A.t - B.t).norm() < least_m_ && A.R.col(2).dot(B.R.col(2)) > alike_cos_;
    }
    bool hasLike(std::size_t k, const Cube& cube) const {
        for (int i = 0; i < 27; ++i) {
            const auto near =
                kept_in_.find({cube[0] + i % 3 - 1, cube[1] + i / 3 % 3 - 1, cube[2] + i / 9 - 1});
            if (near == kept_in_.end()) continue;
            const auto& others = near->second;
            if (std::any_of(others.begin(), others.end(),
                            [&](std::size_t other) { return isAlike(k, other); }))
                return true;
        }
        return false;
    }

    const Trajectory& keyframes_;
    double least_m_, alike_cos_;
    std::map<Cube, std::vector<std::size_t>> kept_in_;
    std::vector<std::size_t> kept_;
};

}  // namespace

Framing framingOf(const PointMap& points, const Trajectory& keyframes, const Trajectory& path,
                  double highest_m) {
    const std::vector<Weighted> poses = unweighted(path),
                                seen = weighted(points, keyframes, highest_m);
    Framing framing;
    for (const auto* all : {&poses, &seen}) {
        const Eigen::AlignedBox3d middle = middleOf(*all);
        if (!middle.isEmpty()) framing.box.extend(middle);
    }
    for (const auto* all : {&poses, &seen}) {
        const std::size_t step = all->size() / most_framed + 1;
        for (std::size_t i = 0; i < all->size(); i += step)
            if (framing.box.contains((*all)[i].position))
                framing.points.push_back((*all)[i].position);
    }
    return framing;
}

double ceilingCut(const Trajectory& path, double lowest_m) {
    constexpr double margin_m = 0.1;
    double cut_m = lowest_m;
    for (const StampedPose& pose : path) cut_m = std::max(cut_m, pose.T_world_cam.t.z() + margin_m);
    return cut_m;
}

double pictureCeiling(const MapInputs& inputs) {
    if (inputs.up_is_guessed) return std::numeric_limits<double>::infinity();
    return ceilingCut(inputs.trajectory);
}

std::vector<std::size_t> sparseKeyframes(const Trajectory& keyframes, double least_m,
                                         double least_rad) {
    KeptKeyframes kept(keyframes, least_m, std::cos(least_rad));
    for (std::size_t k = 0; k < keyframes.size(); ++k)
        if (keyframes[k].T_world_cam.t.allFinite()) kept.offer(k);
    return kept.all();
}

double frustumDepth(const Trajectory& keyframes) {
    constexpr double smallest_m = 0.06, largest_m = 0.2;
    if (keyframes.size() < 2) return 0.1;
    double path_m = 0;
    for (std::size_t k = 1; k < keyframes.size(); ++k)
        path_m += (keyframes[k].T_world_cam.t - keyframes[k - 1].T_world_cam.t).norm();
    return std::clamp(path_m / static_cast<double>(keyframes.size() - 1), smallest_m, largest_m);
}

}  // namespace rgbd_graphslam
