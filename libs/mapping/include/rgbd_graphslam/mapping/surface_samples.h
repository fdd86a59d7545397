/** From pixels to voxels of surface. */
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/depth_view.h"
#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {

/** Sums over readings that fall into one voxel. */
struct SurfaceSample {
    float weight = 0;  // sum of the readings' weights
    Eigen::Vector3f offset =
        Eigen::Vector3f::Zero();  // weighted; from the voxel's lower corner, in voxels
    Eigen::Vector3f color = Eigen::Vector3f::Zero();  // weighted; BGR, 0 to 255
    int readings = 0;

    void add(const SurfaceSample& other) {
        weight += other.weight;
        offset += other.offset;
        color += other.color;
        readings += other.readings;
    }
};

/** Walks over every `step`-th pixel of every `step`-th row. */
class SurfaceSampler {
  public:
    SurfaceSampler(const DepthView& view, const SE3& T_world_cam, double voxel_m, int step = 1);

    /** Calls consume(voxel, sample) for each run of neighboring readings of a row that fall into
     * one voxel: far fewer calls than readings, for voxels larger than a pixel. A reading weighs 1
     * / sigma_z(z)^2, with sigma_z in units of its value at 1 m: that is how far it can be trusted.
     */
    template <class Consumer>
    void forEachRun(Consumer&& consume) const {
        for (int v = 0; v < view_.depth.rows; v += step_) {
            Run run;
            for (int u = 0; u < view_.depth.cols; u += step_) {
                const float z = view_.depth(v, u);
                if (z <= 0 || z > max_range_) continue;
                const Eigen::Vector2f& ray = view_.rays.row(v)[u];
                const Eigen::Vector3f p =
                    z * (R_.col(0) * ray.x() + R_.col(1) * ray.y() + R_.col(2)) + t_;
                const Eigen::Vector3i voxel = p.cast<int>();  // rounds down, for p is positive
                if (run.readings > 0 && voxel != run.voxel) finish(run, consume);
                run.add(voxel, p, z, view_.color(v, u));
            }
            if (run.readings > 0) finish(run, consume);
        }
    }

  private:
    /** Readings of one voxel, as yet without weight: they lie so near each other that they have
     *  the same. */
    struct Run {
        int readings = 0;
        float z = 0;
        Eigen::Vector3i voxel = Eigen::Vector3i::Zero();
        Eigen::Vector3f position = Eigen::Vector3f::Zero();
        Eigen::Vector3i color = Eigen::Vector3i::Zero();
        void add(const Eigen::Vector3i& where, const Eigen::Vector3f& p, float depth,
                 const cv::Vec3b& bgr) {
            ++readings;
            z = depth;
            voxel = where;
            position += p - where.cast<float>();
            color += Eigen::Vector3i(bgr[0], bgr[1], bgr[2]);
        }
    };

    template <class Consumer>
    void finish(Run& run, Consumer& consume) const {
        const float w = weight(run.z);
        const Eigen::Vector3i at = base_voxel_ + run.voxel;
        consume(VoxelIndex{at.x(), at.y(), at.z()},
                SurfaceSample{w * run.readings, w * run.position, w * run.color.cast<float>(),
                              run.readings});
        run = Run();
    }

    float weight(float z) const {
        const auto sigmas = static_cast<float>(view_.noise.sigma(z) / view_.noise.sigma(1));
        return 1 / (sigmas * sigmas);
    }

    const DepthView& view_;
    int step_;
    float max_range_;
    // Positions are taken relative to a voxel beyond the reach of the view: single precision is
    // exact enough there however far the camera is from the origin, and all are positive.
    Eigen::Vector3i base_voxel_;
    Eigen::Matrix3f R_;
    Eigen::Vector3f t_;
};

}  // namespace rgbd_graphslam
