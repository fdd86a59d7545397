/** The viewer's eye, which circles around a point. */
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace rgbd_graphslam {

/** Looks at `target` from a distance. World z is up. Pixels count from the top-left corner of the
 *  view. */
class OrbitCamera {
  public:
    static constexpr double field_of_view_rad = 0.8;  // vertical

    Eigen::Vector3d target = Eigen::Vector3d::Zero();
    /** Where the eye stands, seen from the target: from +x to +y, and above the horizon. */
    double azimuth_rad = -2.1, elevation_rad = 0.9;
    double distance_m = 5;

    Eigen::Vector3d eye() const { return target + distance_m * backward(); }

    /** Turns around the target so that the scene follows the mouse. \param motion_px of the mouse
     */
    void orbit(const Eigen::Vector2d& motion_px);
    /** Moves the target in the picture's plane, so that it stays under the mouse. */
    void pan(const Eigen::Vector2d& motion_px, int height_px);
    /** \param factor on the distance; the world under `pixel` stays where it is */
    void zoom(double factor, const Eigen::Vector2d& pixel, const Eigen::Vector2i& size_px);
    /** From straight above, +y up in the picture. */
    void lookDown();
    /** Moves back until the box fits into the view, whatever its shape.
     *  \param share of the view's width and height, round its center, that may be used */
    void frame(const Eigen::AlignedBox3d& box, const Eigen::Vector2i& size_px,
               const Eigen::Vector2d& share = {1, 1});

    /** Moves so that all points are in the view and fill it, which brings it nearer than their box
     *  would. */
    void frame(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector2i& size_px,
               const Eigen::Vector2d& share = {1, 1});

    /** World to OpenGL's clip coordinates. */
    Eigen::Matrix4d clipFromWorld(const Eigen::Vector2i& size_px) const;
    /** Pixel (x, y) of a world point and its distance along the view direction (m), which is not
     *  positive behind the eye. */
    Eigen::Vector3d project(const Eigen::Vector3d& p, const Eigen::Vector2i& size_px) const;
    /** World point at a pixel. \param depth as OpenGL's depth buffer holds it, 0 to 1 */
    Eigen::Vector3d unproject(const Eigen::Vector2d& pixel, double depth,
                              const Eigen::Vector2i& size_px) const;
    /** Pixels per radian at the center of the view. */
    static double focalPx(int height_px);

  private:
    Eigen::Vector3d backward() const;
    Eigen::Vector3d right() const;
    Eigen::Vector3d up() const { return backward().cross(right()); }
    Eigen::Matrix4d eyeFromWorld() const;
    /** Near and far planes follow the distance, so that depth keeps its precision. */
    double nearest_m() const { return 0.005 * distance_m; }
    double farthest_m() const { return 50 * distance_m + 100; }
};

}  // namespace rgbd_graphslam
