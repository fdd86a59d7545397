#include "shaders.h"

namespace rgbd_graphslam {

const char* const surface_vertex_shader = R"(#version 330 core
in vec3 position;
in vec4 color;
uniform mat4 clip_from_world;
uniform float highest, shade, spacing_px, least_px, most_px;
uniform vec2 height_range;
uniform int by_height;
uniform vec3 palette[32];
out vec3 tint;
vec3 heightColor(float z) {
    float share = (z - height_range.x) / (height_range.y - height_range.x);
    float place = 31.0 * clamp(share, 0.0, 1.0);
    int low = int(min(place, 30.0));
    return mix(palette[low], palette[low + 1], place - float(low));
}
void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
    gl_ClipDistance[0] = highest - position.z;
    gl_PointSize = clamp(spacing_px / gl_Position.w, least_px, most_px);
    // Alpha tells how much light falls on the surface.
    tint = shade * color.a * (by_height != 0 ? heightColor(position.z) : color.rgb);
})";

const char* const surface_fragment_shader = R"(#version 330 core
in vec3 tint;
uniform float alpha;
out vec4 pixel;
void main() { pixel = vec4(tint, alpha); })";

const char* const line_vertex_shader = R"(#version 330 core
in vec3 position;
in vec4 color;
uniform mat4 clip_from_world;
out vec3 end_color;
void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
    end_color = color.rgb;
})";

/** Core profiles draw lines one pixel wide; these become rectangles. */
const char* const line_geometry_shader = R"(#version 330 core
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec2 size_px;
uniform float width_px;
in vec3 end_color[];
out vec3 tint;
const float nearest = 1e-3;
vec4 before(vec4 a, vec4 b) {  // the part of a-b in front of the eye begins here
    return a.w >= nearest ? a : mix(a, b, (nearest - a.w) / (b.w - a.w));
}
void corner(vec4 p, vec2 offset, vec3 c) {
    gl_Position = p + vec4(offset * p.w, 0.0, 0.0);
    tint = c;
    EmitVertex();
}
void main() {
    vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
    if (a.w < nearest && b.w < nearest) return;
    vec4 from = before(a, b), to = before(b, a);
    vec2 along = (to.xy / to.w - from.xy / from.w) * size_px;
    float pixels = length(along);
    vec2 unit = pixels > 1e-6 ? along / pixels : vec2(1.0, 0.0);
    vec2 offset = width_px * vec2(-unit.y, unit.x) / size_px;
    corner(from, offset, end_color[0]);
    corner(from, -offset, end_color[0]);
    corner(to, offset, end_color[1]);
    corner(to, -offset, end_color[1]);
    EndPrimitive();
})";

}  // namespace rgbd_graphslam
