#include "rgbd_graphslam/mapping/free_space.h"

#include <algorithm>
#include <cmath>

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
          camera_(view.rays.pinhole()),
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
        const Image image = imageOf(low, high);
        if (image.right <= -1 || image.left >= camera_.width || image.bottom <= -1 ||
            image.top >= camera_.height)
            return Sight::Unseen;
        return compare(image, cube.size, low.z(), high.z());
    }

    /** A rectangle that may reach beyond the camera's image, pixels. */
    struct Image {
        double left, top, right, bottom;
        /** Of the whole pixels that it touches. */
        double area() const {
            return (std::ceil(right) - std::floor(left) + 1) *
                   (std::ceil(bottom) - std::floor(top) + 1);
        }
    };

    Image imageOf(const Eigen::Vector3f& low, const Eigen::Vector3f& high) const {
        const float at_near = 1 / low.z(), at_far = 1 / high.z();
        const auto least = [&](float x) { return x * (x < 0 ? at_near : at_far); };
        const auto most = [&](float x) { return x * (x > 0 ? at_near : at_far); };
        const Eigen::Vector2d top_left = camera_.fromPlane({least(low.x()), least(low.y())});
        const Eigen::Vector2d bottom_right = camera_.fromPlane({most(high.x()), most(high.y())});
        return {top_left.x(), top_left.y(), bottom_right.x(), bottom_right.y()};
    }

    /** What the camera's image holds of it. */
    PixelRect seenPartOf(const Image& image) const {
        const auto first = [](double x) { return x > 0 ? static_cast<int>(x) : 0; };
        const auto last = [](double x, int size) {
            if (x >= size - 1) return size - 1;
            const int whole = static_cast<int>(x);
            return whole < x ? whole + 1 : whole;
        };
        return {first(image.left), first(image.top), last(image.right, camera_.width),
                last(image.bottom, camera_.height)};
    }

    Sight compare(const Image& image, int size, float near_m, float far_m) const {
        const PixelRect rect = seenPartOf(image);
        const auto side = sight_.sideOf(rect, near_m, far_m);
        if (side == DepthPyramid::Side::Hidden) return Sight::Unseen;
        if (side == DepthPyramid::Side::Across || far_m > max_range_) return Sight::Mixed;
        const double needed = size == 1 ? enough_readings * image.area() : image.area();
        return sight_.readings(rect) >= needed ? Sight::Free : Sight::Mixed;
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
