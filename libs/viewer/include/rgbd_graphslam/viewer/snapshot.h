/** Pictures of maps without a window. */
#pragma once
#include <mrpt/opengl/COpenGLScene.h>

#include <string>

#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** From where a scene is looked at; the scene is always framed whole. */
struct ViewOptions {
    int width_px = 1280, height_px = 960;
    /** The camera looks from this direction, seen from above; 0 is +x, 90 is +y. */
    double azimuth_deg = -120;
    double elevation_deg = 50;
    /** Above 1 is nearer. */
    double zoom = 1;
    /** Leaves points above people's heads away, so that rooms can be looked into. */
    bool cut_ceiling = true;
};

/** Reads a `.3Dscene`. \throws Error when it is missing, cut off, or no scene */
mrpt::opengl::COpenGLScene loadScene(const std::string& path);

/** Renders with software or hardware OpenGL over EGL; needs no display.
 *  \param scene as makeScene makes it, or any other
 *  \param mesh drawn instead of the scene's points when it has triangles
 *  \throws Error when there is no EGL, or the picture cannot be written */
void renderSnapshot(const mrpt::opengl::COpenGLScene& scene, const ViewOptions& options,
                    const std::string& png_path, const PlyModel& mesh = {});

}  // namespace rgbd_graphslam
