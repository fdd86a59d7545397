#include "rgbd_graphslam/mapping/tsdf_volume.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/free_space.h"

namespace rgbd_graphslam {
namespace {

using Voxel = TsdfVolume::Voxel;
using Block = TsdfVolume::Block;
constexpr int block_size = TsdfVolume::block_size;

/** How much a reading tells. */
struct Trust {
    float weight;
    /** Farther from it the surface is not told of. Noise must seldom reach beyond, or its mean
     *  would not be zero. */
    float truncation_m;
};

Trust trustIn(double z, double voxel_m, const DepthNoise& noise) {
    constexpr double truncation_voxels = 3, truncation_sigmas = 3;
    const double sigma_m = noise.sigma(z), sigmas = sigma_m / noise.sigma(1);
    return {static_cast<float>(1 / (sigmas * sigmas)),
            static_cast<float>(std::max(truncation_voxels * voxel_m, truncation_sigmas * sigma_m))};
}

void fuse(Voxel& voxel, float distance_m, float weight) {
    voxel.weight += weight;
    voxel.distance_m += (distance_m - voxel.distance_m) * (weight / voxel.weight);
}

void fuse(Voxel& voxel, const cv::Vec3b& bgr) {
    constexpr std::uint16_t most_views = 60000;
    if (voxel.color_views < most_views) ++voxel.color_views;
    const float share = 1.f / voxel.color_views;
    for (int i = 0; i < 3; ++i) {
        const float old = voxel.color[i], seen = TsdfVolume::color_steps * bgr[i];
        voxel.color[i] = static_cast<std::uint16_t>(cvRound(old + (seen - old) * share));
    }
}

/** Looks voxels up in one view. */
class ViewFuser {
  public:
    ViewFuser(const SE3& T_world_cam, const DepthView& view, double voxel_m)
        : view_(view),
          camera_(view.rays.camera()),
          rectified_(camera_.rectified()),
          distorted_(camera_.hasDistortion()),
          voxel_m_(voxel_m),
          T_cam_world_(T_world_cam.inverse()),
          step_((T_cam_world_.R * voxel_m).cast<float>()) {}

    void update(const VoxelIndex& block_index, Block& block) const {
        forEachVoxel(block_index, block,
                     [&](const Eigen::Vector3f& p, Voxel& voxel) { update(p, voxel); });
    }

    /** Of a block that the view looks through. Where the image's border cuts it off, or readings
     * are missing, what it holds there may be surface all the same. */
    void carve(const VoxelIndex& block_index, Block& block, const Trust& trust) const {
        forEachVoxel(block_index, block, [&](const Eigen::Vector3f& p, Voxel& voxel) {
            if (voxel.weight == 0) return;
            const auto pixel = pixelOf(p);
            if (pixel && depthAt(*pixel) > 0) fuse(voxel, trust.truncation_m, trust.weight);
        });
    }

  private:
    /** \param visit takes a voxel's place in the camera's frame, and the voxel */
    template <class Visit>
    void forEachVoxel(const VoxelIndex& block_index, Block& block, const Visit& visit) const {
        const Eigen::Vector3d corner(block_index.x, block_index.y, block_index.z);
        const Eigen::Vector3f first =
            (T_cam_world_ * (block_size * voxel_m_ * corner)).cast<float>();
        Voxel* voxel = block.voxels.data();
        for (int z = 0; z < block_size; ++z) {
            for (int y = 0; y < block_size; ++y) {
                Eigen::Vector3f p = first + static_cast<float>(y) * step_.col(1) +
                                    static_cast<float>(z) * step_.col(2);
                for (int x = 0; x < block_size; ++x, ++voxel, p += step_.col(0)) visit(p, *voxel);
            }
        }
    }

    void update(const Eigen::Vector3f& p, Voxel& voxel) const {
        const auto pixel = pixelOf(p);
        if (!pixel) return;
        const float z = depthAt(*pixel);
        if (z <= 0 || z > view_.max_range_m) return;
        const Trust trust = trustIn(z, voxel_m_, view_.noise);
        const float distance_m = (z - p.z()) * (p.norm() / p.z());
        if (distance_m < -trust.truncation_m) return;
        fuse(voxel, std::min(distance_m, trust.truncation_m), trust.weight);
        if (distance_m < trust.truncation_m) fuse(voxel, colorAt(*pixel));
    }

    /** Where the sensor sees a place; nothing outside of its image. */
    std::optional<Eigen::Vector2d> pixelOf(const Eigen::Vector3f& p) const {
        if (p.z() <= 0) return std::nullopt;
        const Eigen::Vector2f ray = p.head<2>() / p.z();
        Eigen::Vector2d pixel = rectified_.project(Eigen::Vector3d(ray.x(), ray.y(), 1), 1);
        if (!camera_.contains(pixel)) return std::nullopt;
        if (!distorted_) return pixel;
        pixel = camera_.unrectify(pixel);
        if (!camera_.contains(pixel)) return std::nullopt;
        return pixel;
    }

    cv::Vec3b colorAt(const Eigen::Vector2d& pixel) const {
        return view_.color(cvRound(pixel.y()), cvRound(pixel.x()));
    }

    /** Between four readings where all are there, else that of the nearest pixel; 0 without. */
    float depthAt(const Eigen::Vector2d& pixel) const {
        const int u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
        const int u1 = std::min(u + 1, camera_.width - 1), v1 = std::min(v + 1, camera_.height - 1);
        const float *top = view_.depth[v], *bottom = view_.depth[v1];
        const float a = top[u], b = top[u1], c = bottom[u], d = bottom[u1];
        const float du = static_cast<float>(pixel.x()) - u, dv = static_cast<float>(pixel.y()) - v;
        if (a > 0 && b > 0 && c > 0 && d > 0)
            return (1 - dv) * ((1 - du) * a + du * b) + dv * ((1 - du) * c + du * d);
        return (dv < 0.5f ? top : bottom)[du < 0.5f ? u : u1];
    }

    const DepthView& view_;
    const Camera& camera_;
    Camera rectified_;
    bool distorted_;
    double voxel_m_;
    SE3 T_cam_world_;
    Eigen::Matrix3f step_;  // columns: from a voxel to the next along x, y and z, m
};

/** Pixels to advance so that a block at the end of the range still gets four readings a row. */
int samplingStep(const Camera& camera, double block_m, double max_range_m) {
    return std::max(1,
                    static_cast<int>(camera.pixelsPerRadian().x() * block_m / (4 * max_range_m)));
}

}  // namespace

TsdfVolume::TsdfVolume(double voxel_m) : voxel_m_(voxel_m) {
    if (!(voxel_m > 0)) throw Error("the voxels of a mesh must have a size", "give meters");
}

void TsdfVolume::insert(const SE3& T_world_cam, const DepthView& view) {
    checkReach(T_world_cam, view.max_range_m);
    ++views_;
    const ViewFuser fuser(T_world_cam, view, voxel_m_);
    for (const std::uint64_t key : takeBlocksNearReadings(T_world_cam, view))
        fuser.update(voxelOfKey(key), *blocks_[key]);
    carve(T_world_cam, view);
}

TsdfVolume::Block& TsdfVolume::block(std::uint64_t key) {
    auto& found = blocks_[key];
    if (!found) found = std::make_unique<Block>();
    return *found;
}

/** Those that a reading, or what lies before or behind it within the truncation, falls into; new
 *  ones are made. */
std::vector<std::uint64_t> TsdfVolume::takeBlocksNearReadings(const SE3& T_world_cam,
                                                              const DepthView& view) {
    const double block_m = block_size * voxel_m_;
    std::vector<std::uint64_t> taken;
    std::uint64_t last = ~0ull;  // neighboring readings mostly share a block
    const auto take = [&](const Eigen::Vector3d& p) {
        const Eigen::Vector3i b = (p / block_m).array().floor().cast<int>();
        const std::uint64_t key = voxelKey({b.x(), b.y(), b.z()});
        if (key == last) return;
        last = key;
        int& last_view = block(key).last_view;
        if (last_view != views_) taken.push_back(key);
        last_view = views_;
    };
    const int step = samplingStep(view.rays.camera(), block_m, view.max_range_m);
    for (int v = 0; v < view.depth.rows; v += step) {
        for (int u = 0; u < view.depth.cols; u += step) {
            const float z = view.depth(v, u);
            if (z <= 0 || z > view.max_range_m) continue;
            const Eigen::Vector2f& ray = view.rays.row(v)[u];
            const Eigen::Vector3d direction = T_world_cam.R * Eigen::Vector3d(ray.x(), ray.y(), 1);
            const double reach = trustIn(z, voxel_m_, view.noise).truncation_m / direction.norm();
            const int steps = static_cast<int>(std::ceil(2 * reach / block_m)) + 1;
            for (int i = -steps; i <= steps; ++i)
                take(T_world_cam.t + (z + reach * i / steps) * direction);
        }
    }
    return taken;
}

/** Blocks that the view looks through. Those near its readings know better already. */
void TsdfVolume::carve(const SE3& T_world_cam, const DepthView& view) {
    const ViewFuser fuser(T_world_cam, view, voxel_m_);
    const double block_m = block_size * voxel_m_;
    const auto carve_block = [&](const VoxelIndex& index) {
        const auto* found = blocks_.find(voxelKey(index));
        if (!found || (*found)->last_view == views_) return;
        const Eigen::Vector3d center =
            block_m * (Eigen::Vector3d(index.x, index.y, index.z).array() + 0.5);
        const Trust trust =
            trustIn(T_world_cam.R.col(2).dot(center - T_world_cam.t), voxel_m_, view.noise);
        fuser.carve(index, **found, trust);
    };
    forEachFreeCube(T_world_cam, view, block_m, [&](const VoxelCube& cube) {
        const auto [x0, y0, z0] = cube.corner;
        for (int x = x0; x < x0 + cube.size; ++x)
            for (int y = y0; y < y0 + cube.size; ++y)
                for (int z = z0; z < z0 + cube.size; ++z) carve_block({x, y, z});
    });
}

void TsdfVolume::checkReach(const SE3& T_world_cam, double range_m) const {
    const double farthest = T_world_cam.t.cwiseAbs().maxCoeff() + 2 * range_m;
    if (farthest < voxel_index_limit * voxel_m_) return;
    throw Error("a keyframe " + std::to_string(farthest) +
                    " m from the origin is out of reach for a mesh of " + std::to_string(voxel_m_) +
                    " m",
                "check the trajectory");
}

std::size_t TsdfVolume::bytes() const {
    return blocks_.bytes() + blocks_.entries().size() * sizeof(Block);
}

}  // namespace rgbd_graphslam
