#include "rgbd_graphslam/mapping/floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace rgbd_graphslam {
namespace {

constexpr double level_cos = 0.97;    // 14 degrees
constexpr double thickness_m = 0.05;  // of a level surface, with noise
constexpr double cell_m = 0.15;
constexpr double most_seen_through = 0.5;
constexpr std::size_t enough_rays = 500;

/** A ray from a camera to a patch. */
struct Ray {
    Eigen::Vector3d from, to;
};

/** Places of level patches, in cells of the ground plan. */
class LevelPlaces {
  public:
    LevelPlaces(const std::vector<SurfaceView>& views, const Eigen::Vector3d& up)
        : up_(up), east_(up.unitOrthogonal()), north_(up.cross(east_)) {
        for (const SurfaceView& view : views) {
            for (const SurfacePatch& patch : view.patches) {
                if (patch.normal.dot(up) >= level_cos) cells_.insert(cellOf(patch.position));
            }
        }
    }

    /** Whether a ray passes a surface at this height where one was seen. */
    bool isCrossed(const Ray& ray, double height_m) const {
        const double from = ray.from.dot(up_), to = ray.to.dot(up_);
        if (from < height_m + thickness_m || to > height_m - 2 * thickness_m) return false;
        const Eigen::Vector3d at = ray.from + (from - height_m) / (from - to) * (ray.to - ray.from);
        for (const double near : {-thickness_m, 0., thickness_m}) {
            if (cells_.count(cellOf(at + near * up_)) > 0) return true;
        }
        return false;
    }

  private:
    using Cell = std::array<int, 3>;
    Cell cellOf(const Eigen::Vector3d& p) const {
        const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
        return {whole(p.dot(east_) / cell_m), whole(p.dot(north_) / cell_m),
                whole(p.dot(up_) / thickness_m)};
    }

    const Eigen::Vector3d up_, east_, north_;
    std::set<Cell> cells_;
};

/** To a surface's patches, thinned out. */
std::vector<Ray> raysTo(const std::vector<SurfaceView>& views, const Eigen::Vector3d& up,
                        double height_m) {
    std::vector<Ray> rays;
    for (const SurfaceView& view : views) {
        for (const SurfacePatch& patch : view.patches) {
            const bool near = std::abs(patch.position.dot(up) - height_m) < thickness_m;
            if (near && patch.normal.dot(up) >= level_cos) {
                rays.push_back({view.eye, patch.position});
            }
        }
    }
    const std::size_t step = 1 + rays.size() / enough_rays;
    std::vector<Ray> some;
    for (std::size_t i = 0; i < rays.size(); i += step) some.push_back(rays[i]);
    return some;
}

/** \param higher heights of the surfaces above */
bool isSeenThrough(const std::vector<Ray>& rays, const LevelPlaces& places,
                   const std::vector<double>& higher) {
    const auto crosses = [&](const Ray& ray) {
        return std::any_of(higher.begin(), higher.end(),
                           [&](double height_m) { return places.isCrossed(ray, height_m); });
    };
    const auto through = std::count_if(rays.begin(), rays.end(), crosses);
    return static_cast<double>(through) > most_seen_through * static_cast<double>(rays.size());
}

double shareBelow(const std::vector<SurfaceView>& views, const Eigen::Vector3d& up,
                  double height_m) {
    // A slightly wrong up tilts what is far away.
    constexpr double clearly_m = 0.15, tilt = 0.06;
    std::size_t below = 0, all = 0;
    for (const SurfaceView& view : views) {
        for (const SurfacePatch& patch : view.patches) {
            const double distance_m = (patch.position - view.eye).norm();
            below += patch.position.dot(up) < height_m - clearly_m - tilt * distance_m;
            ++all;
        }
    }
    return static_cast<double>(below) / static_cast<double>(std::max<std::size_t>(1, all));
}

}  // namespace

std::optional<Floor> findFloor(const std::vector<SurfaceView>& views, const Eigen::Vector3d& up) {
    std::vector<SurfacePatch> patches;
    for (const SurfaceView& view : views) {
        patches.insert(patches.end(), view.patches.begin(), view.patches.end());
    }
    const std::vector<double> heights = levelHeights(patches, up);
    if (heights.empty()) return std::nullopt;
    const LevelPlaces places(views, up);
    double floor_m = heights.front();
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::vector<double> higher(heights.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                         heights.end());
        if (isSeenThrough(raysTo(views, up, heights[i]), places, higher)) continue;
        floor_m = heights[i];
        break;
    }
    return Floor{floor_m, shareBelow(views, up, floor_m)};
}

}  // namespace rgbd_graphslam
