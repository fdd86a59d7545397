/** Pictures and exact depth of a scene, drawn off-screen. */
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** What each pixel shows, CV_8UC1. */
struct LabelPicture {
    cv::Mat label;  // values of Label
    cv::Mat mask;   // 255: one of the scene's figures
};

/** Draws with mrpt::opengl::CFBORender, which needs no display. All calls must come from the thread
 *  that made the object. */
class Renderer {
  public:
    /** Bakes the light into the scene's faces and loads its pictures.
     *  \param camera without distortion
     *  \throws Error when no OpenGL context can be made */
    Renderer(const Scene& scene, const Camera& camera);
    ~Renderer();

    /** Moves a figure of the scene: `T_world_figure` maps its coordinates to the world. */
    void placeFigure(int index, const SE3& T_world_figure);

    /** \param shift_px moves the picture's content by a part of a pixel, for anti-aliasing
     *  \return CV_8UC3, BGR; pixel (u, v) sees the ray of camera.unproject(u, v, 1) */
    cv::Mat color(const SE3& T_world_cam, const Eigen::Vector2d& shift_px = {0, 0});

    /** \return CV_32FC1, meters along the optical axis; 0 where nothing is seen. Exact to
     *  0.02 mm: it is coded into the colors, because MRPT's own depth comes from a buffer of
     *  16 bits (up to 1 mm off at 4 m). */
    cv::Mat depth(const SE3& T_world_cam, const Eigen::Vector2d& shift_px = {0, 0});

    LabelPicture labels(const SE3& T_world_cam);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rgbd_graphslam::synth
