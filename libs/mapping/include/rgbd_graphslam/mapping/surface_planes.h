/** Where the surface runs, from the readings of all views together. */
#pragma once
#include <Eigen/Core>
#include <optional>

#include "rgbd_graphslam/mapping/surface_cells.h"

namespace rgbd_graphslam {

/** Points p with normal.dot(p) == offset_m. */
struct Plane {
    Eigen::Vector3d normal;  // unit vector
    double offset_m = 0;

    /** Whether it runs through a cube. */
    bool crosses(const Eigen::Vector3d& center, double edge_m) const {
        return std::abs(normal.dot(center) - offset_m) <= edge_m / 2 * normal.cwiseAbs().sum();
    }
};

/** Tells voxels that hold surface from those beside them that noise spilled into: a single reading
 *  errs by centimeters, the plane through what all views read about a place does not. */
class SurfacePlanes {
  public:
    /** \param cells of half a voxel's edge; must outlive this */
    explicit SurfacePlanes(const SurfaceCells& cells);

    /** Whether the surface runs through a voxel with readings in it: whether the plane does that
     *  moving least squares (Levin, "Mesh-independent surface interpolation", 2003) fit to the
     *  cells around, in the smallest neighborhood where readings lie flat and are enough. Where
     *  none is flat, as on thin and small things and at corners, it does if the voxel's own
     *  readings tell their mean to half a voxel. */
    bool cross(const VoxelIndex& voxel) const;

  private:
    struct Mean {
        Eigen::Vector3d position;  // in cells
        double weight = 0;         // 0 without readings
    };
    Mean meanIn(const VoxelIndex& voxel) const;
    /** Standard deviation of the mean of readings of that weight. */
    double sigmaVoxels(double weight) const;
    /** \param middle in cells of this size
     *  \return nothing where readings are few or do not lie flat */
    std::optional<Plane> planeAround(const SurfaceCells& cells, const Eigen::Vector3d& middle,
                                     double radius_cells) const;

    double voxel_m_;
    const SurfaceCells& cells_;
    SurfaceCells coarse_, coarsest_;  // of one voxel's edge, and of two
};

}  // namespace rgbd_graphslam
