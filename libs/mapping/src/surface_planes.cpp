#include "rgbd_graphslam/mapping/surface_planes.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace rgbd_graphslam {
namespace {

/** Where a plane is looked for: cells within a radius, wide ones for readings from afar, which lie
 *  in a thick layer. */
struct Neighborhood {
    int level;  // of cells: 0 are half a voxel wide, each next one twice as much
    double radius_cells;
    /** How uncertain a voxel's own readings must be for it: elsewhere it would take what stands out
     *  of a wall for noise. */
    double least_sigma_voxels;
};
constexpr Neighborhood neighborhoods[] = {{0, 2.4, 0}, {0, 4.8, 0}, {1, 4.8, 0.04}, {2, 4.8, 0.17}};
/** What the readings of a neighborhood tell less exactly is no plane: any three lie in one. */
constexpr double plane_sigma_voxels = 0.07;
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

/** From the origin of coordinates, in cells. */
Eigen::Vector3d meanOf(const VoxelIndex& index, const SurfaceCells::Cell& cell) {
    return Eigen::Vector3d(index.x, index.y, index.z) + (cell.offset / cell.weight).cast<double>();
}

}  // namespace

SurfacePlanes::SurfacePlanes(const SurfaceCells& cells)
    : voxel_m_(2 * cells.cellSize()),
      cells_(cells),
      coarse_(cells.coarser()),
      coarsest_(coarse_.coarser()) {}

bool SurfacePlanes::cross(const VoxelIndex& voxel) const {
    constexpr double half_a_voxel = 0.5;
    const Mean own = meanIn(voxel);
    const double sigma = sigmaVoxels(own.weight);
    const Eigen::Vector3d center(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5);
    const SurfaceCells* const levels[] = {&cells_, &coarse_, &coarsest_};
    for (const auto& [level, radius, least_sigma] : neighborhoods) {
        if (sigma < least_sigma) break;
        const Eigen::Vector3d middle = own.position / (1 << level);
        if (const auto plane = planeAround(*levels[level], middle, radius))
            return plane->crosses(voxel_m_ * center, voxel_m_);
    }
    return sigma <= half_a_voxel;
}

SurfacePlanes::Mean SurfacePlanes::meanIn(const VoxelIndex& voxel) const {
    Mean mean{Eigen::Vector3d::Zero()};
    const VoxelIndex low{2 * voxel.x, 2 * voxel.y, 2 * voxel.z};
    cells_.table().forEachWithin(low, {low.x + 1, low.y + 1, low.z + 1},
                                 [&](const VoxelIndex& index, const SurfaceCells::Cell& cell) {
                                     mean.position += cell.weight * meanOf(index, cell);
                                     mean.weight += cell.weight;
                                 });
    mean.position /= mean.weight;
    return mean;
}

double SurfacePlanes::sigmaVoxels(double weight) const {
    return DepthNoise().sigma(1) / std::sqrt(weight) / voxel_m_;
}

std::optional<Plane> SurfacePlanes::planeAround(const SurfaceCells& cells,
                                                const Eigen::Vector3d& middle,
                                                double radius_cells) const {
    const int reach = static_cast<int>(std::ceil(radius_cells));
    const Eigen::Vector3i home = middle.array().floor().cast<int>();
    const Eigen::Vector3f from_home = (middle - home.cast<double>()).cast<float>();
    const auto wide = static_cast<float>(radius_cells);
    constexpr float half_diagonal = 0.87f;
    const float touched = (wide + half_diagonal) * (wide + half_diagonal);
    Moments moments;
    float support = 0;
    const auto add = [&](const VoxelIndex& index, const SurfaceCells::Cell& cell) {
        const Eigen::Vector3f corner =
            (Eigen::Vector3i(index.x, index.y, index.z) - home).cast<float>() - from_home;
        if ((corner.array() + 0.5f).matrix().squaredNorm() > touched) return;
        const Eigen::Vector3f p = corner + cell.offset / cell.weight;
        const float share = 1 - p.squaredNorm() / (wide * wide);
        if (share <= 0) return;
        support += cell.weight;
        moments.add(p, share * share * cell.weight);
    };
    cells.table().forEachWithin({home.x() - reach, home.y() - reach, home.z() - reach},
                                {home.x() + reach, home.y() + reach, home.z() + reach}, add);
    if (!(sigmaVoxels(support) <= plane_sigma_voxels)) return std::nullopt;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(moments.covariance());
    const Eigen::Vector3d& variance = axes.eigenvalues();
    if (variance[0] > flatness * flatness * variance[1]) return std::nullopt;
    const Eigen::Vector3d normal = axes.eigenvectors().col(0);
    return Plane{normal, cells.cellSize() * normal.dot(middle + moments.mean())};
}

}  // namespace rgbd_graphslam
