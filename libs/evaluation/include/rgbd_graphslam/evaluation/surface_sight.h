/** Which part of a true surface a camera saw on its way. */
#pragma once
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** The limits within which the camera measures. */
struct SightOptions {
    /** Depth along the optical axis within which the camera measures. */
    double min_range_m = 0.3, max_range_m = 5;
    /** Angle between ray and normal up to which the camera measures. A Kinect's pattern is lost on
     *  what it sees flatter than this. */
    double max_incidence_deg = 80;
    /** Of the poses no more than so many are looked from, evenly chosen. */
    std::size_t max_views = 100;
};

/** Images of a mesh as a camera without distortion sees it from each pose: which triangle is in
 *  front at each pixel. */
class SurfaceSight {
  public:
    /** \param surface triangles, in the frame of the poses
     *  \param cameras camera to world
     *  \throws Error for a surface without triangles or no pose */
    SurfaceSight(const PlyModel& surface, const Camera& camera, const Trajectory& cameras,
                 const SightOptions& options = {});

    /** Whether one of the views shows this place of the surface: within range, and seen steeply
     *  enough, and no triangle stands before it.
     *  \param p on the surface, give or take a millimeter */
    bool sees(const Eigen::Vector3d& p) const;

  private:
    struct View {
        SE3 T_cam_world;
        std::vector<std::int32_t> triangle;  // in front at each pixel, or -1
    };
    Eigen::Vector3d corner(std::size_t triangle, int which) const;
    View render(const SE3& T_cam_world) const;
    void draw(std::size_t triangle, View& view, std::vector<float>& inverse_depth) const;
    bool shows(const View& view, const Eigen::Vector3d& p) const;
    bool liesOn(std::int32_t triangle, const Eigen::Vector3d& p) const;
    bool isSteep(std::int32_t triangle, const Eigen::Vector3d& ray) const;

    PlyModel surface_;
    Camera camera_;  // of a quarter of the pixels
    SightOptions options_;
    double least_cosine_;
    std::vector<Eigen::Vector4d> planes_;  // normal and offset of each triangle, world
    std::vector<View> views_;
};

}  // namespace rgbd_graphslam
