/** Light that falls on surfaces: lamps with shadows, and ambient light that corners keep out. */
#pragma once
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** Answers how bright a point is, by marching rays through an occupancy grid of the scene. */
class Lighting {
  public:
    explicit Lighting(const Scene& scene);

    /** \param normal unit vector away from the surface
     *  \return blue, green, red factors of the surface's color, 1 = as painted */
    Eigen::Vector3d at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  private:
    void occupy(const Quad& quad);
    bool occupied(const Eigen::Vector3d& point) const;
    /** Free length of a ray (m), at most `reach`. */
    double freeLength(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                      double reach) const;
    double openness(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

    const Scene& scene_;
    Eigen::Vector3d origin_;
    Eigen::Vector3i size_;
    std::vector<std::uint8_t> cells_;
    std::vector<Eigen::Vector3d> directions_;
};

}  // namespace rgbd_graphslam::synth
