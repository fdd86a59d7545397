#include "rgbd_graphslam/mapping/free_space.h"

#include <algorithm>
#include <array>

namespace rgbd_graphslam {
namespace {

constexpr int largest_cube = 64;  // voxels; also the size of the tiles the search starts from
constexpr float nearest_plane_m = 0.05f;  // cubes cannot be projected from nearer by
constexpr double enough_readings = 0.5;   // share of a voxel's image that must have depth

enum class Sight { Free, Unseen, Mixed };

class Carver {
  public:
    Carver(const SE3& T_world_cam, const DepthView& view, double resolution_m,
           const std::function<void(const VoxelCube&)>& carve)
        : sight_(view.sight),
          camera_(view.rays.camera()),
          max_range_(static_cast<float>(view.max_range_m)),
          resolution_(resolution_m),
          T_world_cam_(T_world_cam),
          R_cam_world_(T_world_cam.R.transpose().cast<float>()),
          // A box turned into the camera's frame reaches this far along its axes.
          reach_(R_cam_world_.cwiseAbs().rowwise().sum() * static_cast<float>(0.5 * resolution_m)),
          carve_(carve) {}

    void run() {
        const auto [low, high] = frustumTiles();
        for (int x = low.x(); x <= high.x(); ++x) {
            for (int y = low.y(); y <= high.y(); ++y) {
                for (int z = low.z(); z <= high.z(); ++z) {
                    visit({{x * largest_cube, y * largest_cube, z * largest_cube}, largest_cube});
                }
            }
        }
    }

  private:
    std::pair<Eigen::Vector3i, Eigen::Vector3i> frustumTiles() const {
        const double z = std::min(sight_.farthest(), max_range_);
        Eigen::Vector3d low = T_world_cam_.t, high = T_world_cam_.t;
        for (const double u : {0., camera_.width - 1.}) {
            for (const double v : {0., camera_.height - 1.}) {
                const Eigen::Vector3d corner = T_world_cam_ * camera_.unproject(u, v, z);
                low = low.cwiseMin(corner);
                high = high.cwiseMax(corner);
            }
        }
        const double tile = largest_cube * resolution_;
        return {(low / tile).array().floor().cast<int>(),
                (high / tile).array().floor().cast<int>()};
    }

    void visit(const VoxelCube& cube) {
        const Sight sight = classify(cube);
        if (sight == Sight::Unseen) return;
        if (sight == Sight::Free) return carve_(cube);
        if (cube.size == 1) return;
        const int half = cube.size / 2;
        for (int octant = 0; octant < 8; ++octant) {
            visit(
                {{cube.corner.x + (octant & 1 ? half : 0), cube.corner.y + (octant & 2 ? half : 0),
                  cube.corner.z + (octant & 4 ? half : 0)},
                 half});
        }
    }

    /** Conservative: the box's image is taken as the rectangle around the image of its bounding box
     *  in the camera's frame. */
    Sight classify(const VoxelCube& cube) const {
        const double half = 0.5 * cube.size;
        const Eigen::Vector3d center(cube.corner.x + half, cube.corner.y + half,
                                     cube.corner.z + half);
        const Eigen::Vector3f c =
            R_cam_world_ * (resolution_ * center - T_world_cam_.t).cast<float>();
        const Eigen::Vector3f low = c - cube.size * reach_, high = c + cube.size * reach_;
        if (high.z() < nearest_plane_m || low.z() > max_range_) return Sight::Unseen;
        if (low.z() < nearest_plane_m) return Sight::Mixed;
        return compare(image(low, high), cube.size, low.z(), high.z());
    }

    Sight compare(const PixelRect& whole, int size, float near, float far) const {
        const PixelRect rect{std::max(whole.u0, 0), std::max(whole.v0, 0),
                             std::min(whole.u1, camera_.width - 1),
                             std::min(whole.v1, camera_.height - 1)};
        if (rect.u0 > rect.u1 || rect.v0 > rect.v1) return Sight::Unseen;
        const DepthPyramid::Range seen = sight_.range(rect);
        if (seen.farthest <= near) return Sight::Unseen;
        if (seen.nearest <= far || far > max_range_) return Sight::Mixed;
        const double needed = size == 1 ? enough_readings * whole.area() : whole.area();
        return sight_.readings(rect) >= needed ? Sight::Free : Sight::Mixed;
    }

    PixelRect image(const Eigen::Vector3f& low, const Eigen::Vector3f& high) const {
        const float at_near = 1 / low.z(), at_far = 1 / high.z();
        const auto least = [&](float x) { return x * (x < 0 ? at_near : at_far); };
        const auto most = [&](float x) { return x * (x > 0 ? at_near : at_far); };
        const auto pixel = [](double x) { return static_cast<int>(std::clamp(x, -1e6, 1e6)); };
        return {pixel(std::floor(camera_.fx * least(low.x()) + camera_.cx)),
                pixel(std::floor(camera_.fy * least(low.y()) + camera_.cy)),
                pixel(std::ceil(camera_.fx * most(high.x()) + camera_.cx)),
                pixel(std::ceil(camera_.fy * most(high.y()) + camera_.cy))};
    }

    const DepthPyramid& sight_;
    const Camera& camera_;
    float max_range_;
    double resolution_;
    const SE3& T_world_cam_;
    Eigen::Matrix3f R_cam_world_;
    Eigen::Vector3f reach_;
    const std::function<void(const VoxelCube&)>& carve_;
};

}  // namespace

void forEachFreeCube(const SE3& T_world_cam, const DepthView& view, double resolution_m,
                     const std::function<void(const VoxelCube&)>& carve) {
    Carver(T_world_cam, view, resolution_m, carve).run();
}

}  // namespace rgbd_graphslam
