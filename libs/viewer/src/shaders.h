/** Programs of the graphics card, for OpenGL 3.3. */
#pragma once

namespace rgbd_graphslam {

/** Points and triangles in their colors or those of their height, up to a height. */
extern const char* const surface_vertex_shader;
extern const char* const surface_fragment_shader;

/** Lines of any width; they take the surfaces' fragment shader. */
extern const char* const line_vertex_shader;
extern const char* const line_geometry_shader;

}  // namespace rgbd_graphslam
