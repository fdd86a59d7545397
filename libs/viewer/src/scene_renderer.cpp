#include "scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rgbd_graphslam/viewer/keyframe_view.h"

namespace rgbd_graphslam {
namespace {

constexpr float background[] = {236 / 255.f, 239 / 255.f, 243 / 255.f};
constexpr float most_point_px = 8, widest_spacing_m = 0.02f;
constexpr double frame_time_s = 0.04, fewest_points = 30000, most_points = 2e7;
/** How bright the octree's sides are: -x, +x, -y, +y, -z, +z. */
constexpr float face_shades[] = {0.75f, 0.85f, 0.7f, 0.8f, 0.55f, 1.f};

const char* const surface_vertex_shader = R"(#version 330 core
in vec3 position;
in vec4 color;
uniform mat4 clip_from_world;
uniform float highest, shade, spacing_px, least_px, most_px;
uniform vec2 height_range;
uniform int by_height;
out vec3 tint;
vec3 heightColor(float z) {
    float h = clamp((z - height_range.x) / (height_range.y - height_range.x), 0.0, 1.0);
    float hue = 4.0 * (1.0 - h);  // blue, cyan, green, yellow, red
    return clamp(vec3(2.0 - hue, 2.0 - abs(hue - 2.0), hue - 2.0), 0.08, 0.92);
}
void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
    gl_ClipDistance[0] = highest - position.z;
    gl_PointSize = clamp(spacing_px / gl_Position.w, least_px, most_px);
    tint = shade * (by_height != 0 ? heightColor(position.z) : color.rgb);
})";

const char* const surface_fragment_shader = R"(#version 330 core
in vec3 tint;
out vec4 pixel;
void main() { pixel = vec4(tint, 1.0); })";

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

struct LineWidth {
    Part part;
    float px;
};
constexpr LineWidth line_widths[] = {
    {Part::Floor, 1},     {Part::BeforeLoops, 1.5f}, {Part::Covisibility, 1}, {Part::Errors, 1},
    {Part::Keyframes, 1}, {Part::TruePath, 2},       {Part::Path, 2.5f},      {Part::Loops, 2.5f},
    {Part::NowCamera, 3}, {Part::Selection, 3},      {Part::Measure, 3}};

void drawRanges(const std::vector<DrawRange>& ranges) {
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    for (const DrawRange& range : ranges) {
        firsts.push_back(static_cast<GLint>(range.first));
        counts.push_back(static_cast<GLsizei>(range.count));
    }
    glMultiDrawArrays(GL_POINTS, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
}

/** Of points that lie on surfaces, estimated from chunks as if each were a disc. */
float spacingOf(const std::vector<PointChunk>& chunks) {
    if (chunks.empty()) return widest_spacing_m;
    std::vector<double> spacings;
    for (const PointChunk& chunk : chunks) {
        spacings.push_back(chunk.radius_m * std::sqrt(M_PI / static_cast<double>(chunk.count)));
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return std::min(static_cast<float>(*middle), widest_spacing_m);
}

}  // namespace

SceneRenderer::SceneRenderer()
    : surface_(surface_vertex_shader, "", surface_fragment_shader),
      line_(line_vertex_shader, line_geometry_shader, surface_fragment_shader) {}

void SceneRenderer::setOctree(const std::array<Vertices, 6>& faces) {
    Vertices all;
    for (std::size_t direction = 0; direction < faces.size(); ++direction) {
        octree_starts_[direction] = all.size();
        all.insert(all.end(), faces[direction].begin(), faces[direction].end());
    }
    octree_starts_[6] = all.size();
    buffer(Part::Octree).set(all);
}

void SceneRenderer::setPoints(ChunkedPoints cloud) {
    map_.spacing_m = spacingOf(cloud.chunks);
    map_.buffer.set(cloud.points);
    map_.chunks = std::move(cloud.chunks);
}

void SceneRenderer::setKeyframePoints(std::size_t keyframe, const Vertices& points) {
    auto& chunks = keyframe_clouds_.chunks;
    const std::size_t first = keyframe * points_a_keyframe;
    if (chunks.size() <= keyframe) chunks.resize(keyframe + 1);
    chunks[keyframe] = chunkOf(points, first);
    keyframe_clouds_.buffer.write(first, points);
}

void SceneRenderer::draw(const SceneView& view) {
    view_ = view;
    for (RenderTarget& target : targets_) target.resize(view.size_px);
    chooseCloud();
    const double total = std::max(static_cast<double>(useful_total_), 1.0);
    const double share = std::min(1.0, points_a_frame_ / total);
    const auto start = std::chrono::steady_clock::now();
    drawn_share_ = 0;
    targets_[shown_].bind();
    drawSlice(share, share);
    glFinish();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (share < 1 || taken.count() > frame_time_s) learnSpeed(taken.count());
    if (share < 1) drawn_share_ = 0;  // the complete picture starts from nothing
}

bool SceneRenderer::refine() {
    if (complete()) return false;
    const double step = points_a_frame_ / static_cast<double>(useful_total_);
    targets_[1 - shown_].bind();
    drawSlice(std::min(1.0, drawn_share_ + step), 1);
    glFinish();
    if (complete()) shown_ = 1 - shown_;
    return !complete();
}

void SceneRenderer::chooseCloud() {
    cloud_ = view_.keyframe_clouds > 0 ? &keyframe_clouds_ : &map_;
    useful_.clear();
    if (view_.points) useful_ = usefulPoints(cloud_->chunks, view_.camera, view_.size_px);
    if (view_.keyframe_clouds > 0) useful_.resize(std::min(useful_.size(), view_.keyframe_clouds));
    useful_total_ = std::accumulate(useful_.begin(), useful_.end(), std::size_t{0});
}

void SceneRenderer::learnSpeed(double seconds) {
    const double change = std::clamp(frame_time_s / seconds, 0.7, 1.4);
    points_a_frame_ = std::clamp(change * points_a_frame_, fewest_points, most_points);
}

/** Adds the points up to a share of the useful ones to the picture that is bound. */
void SceneRenderer::drawSlice(double to_share, double density) {
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    if (drawn_share_ == 0) {
        clear();
        drawSolids();
        drawLines();
        points_drawn_ = 0;
    }
    drawPoints(drawn_share_, to_share, density);
    drawn_share_ = to_share;
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void SceneRenderer::clear() {
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(background[0], background[1], background[2], 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/** \param spacing_m between points, all of them; fewer are drawn larger */
void SceneRenderer::prepareSurfaceShader(float spacing_m, double density) {
    const double focal_px = OrbitCamera::focalPx(view_.size_px.y());
    surface_.use();
    const Eigen::Matrix4f clip = view_.camera.clipFromWorld(view_.size_px).cast<float>();
    surface_.set("clip_from_world", clip);
    surface_.set("highest", view_.highest_m);
    surface_.set("shade", 1.f);
    surface_.set("by_height", view_.color_by_height ? 1 : 0);
    surface_.set("height_range", view_.height_range_m);
    surface_.set("spacing_px", static_cast<float>(1.2 * spacing_m * focal_px / std::sqrt(density)));
    surface_.set("least_px", view_.least_point_px);
    surface_.set("most_px", most_point_px);
    glEnable(GL_CLIP_DISTANCE0);
}

void SceneRenderer::drawSolids() {
    prepareSurfaceShader(0, 1);
    drawOctree();
    glDisable(GL_CLIP_DISTANCE0);
    surface_.set("shade", 1.f);
    surface_.set("by_height", 0);
    buffer(Part::Grid).bind();
    glDrawArrays(GL_TRIANGLES, 0,
                 static_cast<GLsizei>(std::min(view_.of(Part::Grid), buffer(Part::Grid).size())));
}

void SceneRenderer::drawOctree() {
    if (view_.of(Part::Octree) == 0) return;
    buffer(Part::Octree).bind();
    for (std::size_t direction = 0; direction < 6; ++direction) {
        const std::size_t first = octree_starts_[direction];
        surface_.set("shade", face_shades[direction]);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first),
                     static_cast<GLsizei>(octree_starts_[direction + 1] - first));
    }
}

void SceneRenderer::drawPoints(double from_share, double to_share, double density) {
    if (useful_total_ == 0) return;
    prepareSurfaceShader(cloud_->spacing_m, density);
    cloud_->buffer.bind();
    const auto ranges = slice(cloud_->chunks, useful_, from_share, to_share);
    for (const DrawRange& range : ranges) points_drawn_ += range.count;
    drawRanges(ranges);
    glDisable(GL_CLIP_DISTANCE0);
}

void SceneRenderer::drawLines() {
    line_.use();
    const Eigen::Matrix4f clip = view_.camera.clipFromWorld(view_.size_px).cast<float>();
    line_.set("clip_from_world", clip);
    const Eigen::Vector2f size_px = view_.size_px.cast<float>();
    line_.set("size_px", size_px);
    for (const auto& [part, width_px] : line_widths) {
        const std::size_t count = std::min(view_.of(part), buffer(part).size());
        if (count == 0) continue;
        line_.set("width_px", width_px);
        buffer(part).bind();
        glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(count));
    }
}

}  // namespace rgbd_graphslam
