#include "rgbd_graphslam/mapping/surface_cells.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <iterator>

namespace rgbd_graphslam {
namespace {

/** Of the neighbourhood; the wide ones serve where readings from afar lie in a thick layer. */
constexpr double radii_cells[] = {2.4, 4.8, 9.6};
/** The widest is for voxels that were read from afar or hardly: elsewhere it would take what stands
 *  out of a wall for noise. In readings from 1 m. */
constexpr double hardly_read = 1;
/** Deviation across the plane over the smaller one along it; 1 is no plane at all. */
constexpr double flatness = 0.45;

/** Weighted sums over points near the origin, for which single precision is exact enough. */
class Moments {
  public:
    void add(const Eigen::Vector3f& p, float w) {
        const Eigen::Vector3f wp = w * p;
        weight_ += w;
        first_ += wp;
        squares_ += wp.cwiseProduct(p);
        products_ += Eigen::Vector3f(wp.x() * p.y(), wp.x() * p.z(), wp.y() * p.z());
    }

    Eigen::Vector3d mean() const { return (first_ / weight_).cast<double>(); }
    Eigen::Matrix3d covariance() const {
        Eigen::Matrix3d second = (squares_ / weight_).cast<double>().asDiagonal();
        const Eigen::Vector3d mixed = (products_ / weight_).cast<double>();
        second(0, 1) = second(1, 0) = mixed[0];
        second(0, 2) = second(2, 0) = mixed[1];
        second(1, 2) = second(2, 1) = mixed[2];
        return second - mean() * mean().transpose();
    }

  private:
    float weight_ = 0;
    Eigen::Vector3f first_ = Eigen::Vector3f::Zero();
    Eigen::Vector3f squares_ = Eigen::Vector3f::Zero();   // xx, yy, zz
    Eigen::Vector3f products_ = Eigen::Vector3f::Zero();  // xy, xz, yz
};

}  // namespace

void SurfaceCells::add(const VoxelIndex& voxel, const VoxelReadings& readings) {
    for (int i = 0; i < 8; ++i) {
        const Cell& more = readings.cells[i];
        if (more.weight <= 0) continue;
        Cell& cell = cells_[voxelKey(
            {2 * voxel.x + (i & 1), 2 * voxel.y + (i >> 1 & 1), 2 * voxel.z + (i >> 2)})];
        cell.weight += more.weight;
        cell.offset += more.offset;
    }
}

Eigen::Vector3d SurfaceCells::meanOf(const VoxelIndex& index, const Cell& cell) {
    return Eigen::Vector3d(index.x, index.y, index.z) + (cell.offset / cell.weight).cast<double>();
}

SurfaceCells::WeightedMean SurfaceCells::meanIn(const VoxelIndex& voxel) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    const VoxelIndex low{2 * voxel.x, 2 * voxel.y, 2 * voxel.z};
    cells_.forEachWithin(low, {low.x + 1, low.y + 1, low.z + 1},
                         [&](const VoxelIndex& index, const Cell& cell) {
                             sum += cell.weight * meanOf(index, cell);
                             weight += cell.weight;
                         });
    return {weight > 0 ? sum / weight : sum, weight};
}

std::optional<Plane> SurfaceCells::planeAt(const VoxelIndex& voxel) const {
    const auto [middle, weight] = meanIn(voxel);
    if (weight <= 0) return std::nullopt;
    for (const double radius : radii_cells) {
        const bool widest = radius == radii_cells[std::size(radii_cells) - 1];
        if (widest && weight > hardly_read) break;
        if (auto plane = planeAround(middle, radius)) return plane;
    }
    return std::nullopt;
}

std::optional<Plane> SurfaceCells::planeAround(const Eigen::Vector3d& middle, double radius) const {
    const int reach = static_cast<int>(std::ceil(radius));
    const Eigen::Vector3i home = middle.array().floor().cast<int>();
    const Eigen::Vector3f from_home = (middle - home.cast<double>()).cast<float>();
    const auto wide = static_cast<float>(radius);
    constexpr float half_diagonal = 0.87f;
    const float touched = (wide + half_diagonal) * (wide + half_diagonal);
    Moments moments;
    const auto add = [&](const VoxelIndex& index, const Cell& cell) {
        const Eigen::Vector3f corner =
            (Eigen::Vector3i(index.x, index.y, index.z) - home).cast<float>() - from_home;
        if ((corner.array() + 0.5f).matrix().squaredNorm() > touched) return;
        const Eigen::Vector3f p = corner + cell.offset / cell.weight;
        const float share = 1 - p.squaredNorm() / (wide * wide);
        if (share > 0) moments.add(p, share * share * cell.weight);
    };
    cells_.forEachWithin({home.x() - reach, home.y() - reach, home.z() - reach},
                         {home.x() + reach, home.y() + reach, home.z() + reach}, add);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(moments.covariance());
    const Eigen::Vector3d& variance = axes.eigenvalues();
    if (variance[0] > flatness * flatness * variance[1]) return std::nullopt;
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    return Plane{normal, cellSize() * normal.dot(middle + moments.mean())};
}

}  // namespace rgbd_graphslam
