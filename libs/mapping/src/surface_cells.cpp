#include "rgbd_graphslam/mapping/surface_cells.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace rgbd_graphslam {
namespace {

/** Of the neighbourhood; the wide one serves where readings from afar lie in a thick layer. */
constexpr double radii_cells[] = {2.4, 4.8};
/** Deviation across the plane over the smaller one along it; 1 is no plane at all. */
constexpr double flatness = 0.45;

/** Weighted sums over points. */
struct Moments {
    double weight = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    void add(const Eigen::Vector3d& p, double w) {
        weight += w;
        first += w * p;
        second += w * p * p.transpose();
    }
};

}  // namespace

void SurfaceCells::add(std::uint64_t cell_key, const SurfaceSample& sample) {
    Cell& cell = cells_[cell_key];
    cell.weight += sample.weight;
    cell.offset += sample.offset;
}

Eigen::Vector3d SurfaceCells::meanOf(const VoxelIndex& index, const Cell& cell) {
    return Eigen::Vector3d(index.x, index.y, index.z) + (cell.offset / cell.weight).cast<double>();
}

std::optional<Eigen::Vector3d> SurfaceCells::meanIn(const VoxelIndex& voxel) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    const VoxelIndex low{2 * voxel.x, 2 * voxel.y, 2 * voxel.z};
    cells_.forEachWithin(low, {low.x + 1, low.y + 1, low.z + 1},
                         [&](const VoxelIndex& index, const Cell& cell) {
                             sum += cell.weight * meanOf(index, cell);
                             weight += cell.weight;
                         });
    if (weight <= 0) return std::nullopt;
    return sum / weight;
}

std::optional<Plane> SurfaceCells::planeAt(const VoxelIndex& voxel) const {
    const auto middle = meanIn(voxel);
    if (!middle) return std::nullopt;
    for (const double radius : radii_cells) {
        const auto plane = planeAround(*middle, radius);
        if (plane) return plane;
    }
    return std::nullopt;
}

std::optional<Plane> SurfaceCells::planeAround(const Eigen::Vector3d& middle, double radius) const {
    const int reach = static_cast<int>(std::ceil(radius));
    const Eigen::Vector3i home = middle.array().floor().cast<int>();
    Moments moments;
    const auto add = [&](const VoxelIndex& index, const Cell& cell) {
        const Eigen::Vector3d p = meanOf(index, cell) - middle;
        const double share = 1 - p.squaredNorm() / (radius * radius);
        if (share > 0) moments.add(p, share * share * cell.weight);
    };
    cells_.forEachWithin({home.x() - reach, home.y() - reach, home.z() - reach},
                         {home.x() + reach, home.y() + reach, home.z() + reach}, add);
    const Eigen::Vector3d mean = moments.first / moments.weight;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(moments.second / moments.weight - mean * mean.transpose());
    const Eigen::Vector3d& variance = axes.eigenvalues();
    if (variance[0] > flatness * flatness * variance[1]) return std::nullopt;
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    return Plane{normal, cellSize() * normal.dot(middle + mean)};
}

}  // namespace rgbd_graphslam
