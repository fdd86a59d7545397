#include "scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/viewer/keyframe_view.h"

namespace rgbd_graphslam {
namespace {

constexpr float background[] = {236 / 255.f, 239 / 255.f, 243 / 255.f};
constexpr float most_point_px = 12, widest_spacing_m = 0.02f;
constexpr float free_alpha = 0.08f;
constexpr double fewest_points = 15000, fewest_sharp_points = 50000, most_points = 2e7;
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

void SceneRenderer::Faces::set(const std::array<Vertices, 6>& faces) {
    Vertices all;
    for (std::size_t direction = 0; direction < faces.size(); ++direction) {
        starts[direction] = all.size();
        all.insert(all.end(), faces[direction].begin(), faces[direction].end());
    }
    starts[6] = all.size();
    buffer.set(all);
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

void SceneRenderer::begin(Picture& picture, int reduction) {
    drawn_ = &picture;
    picture.reduction = reduction;
    size_px_ = (view_.size_px / reduction).cwiseMax(1);
    picture.target.resize(size_px_);
    chooseCloud();
    drawn_share_ = 0;
}

void SceneRenderer::draw(const SceneView& view) {
    view_ = view;
    begin(moving_, coarse_ ? 2 : 1);
    shown_ = &moving_;
    const double total = std::max(static_cast<double>(useful_total_), 1.0);
    const double share = std::min(1.0, points_a_frame_ / total);
    const auto start = std::chrono::steady_clock::now();
    drawSlice(share, share, true);
    glFinish();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (share < 1 || taken.count() > view_.time_s) learnSpeed(taken.count());
    if (share < 1 || moving_.reduction > 1) begin(resting_, 1);
}

bool SceneRenderer::refine() {
    if (complete()) return false;
    const double step = points_a_frame_ / std::max(static_cast<double>(useful_total_), 1.0);
    const double share = std::min(1.0, drawn_share_ + step);
    drawSlice(share, 1, share >= 1);
    glFinish();
    if (complete()) shown_ = &resting_;
    return !complete();
}

void SceneRenderer::copyToWindow() const {
    shown_->target.copyToWindow(cv::Rect(0, 0, view_.size_px.x(), view_.size_px.y()),
                                view_.size_px);
}

cv::Mat1f SceneRenderer::depthsAround(const Eigen::Vector2i& pixel, int radius_px) const {
    const int reduction = shown_->reduction, reduced_radius = radius_px / reduction + 1;
    const Eigen::Vector2i center = pixel / reduction;
    cv::Mat1f depths = shown_->target.depthsAround(center, reduced_radius);
    cv::resize(depths, depths, {}, reduction, reduction, cv::INTER_NEAREST);
    const Eigen::Vector2i corner =
        pixel.array() - radius_px - reduction * (center.array() - reduced_radius);
    return depths(cv::Rect(corner.x(), corner.y(), 2 * radius_px + 1, 2 * radius_px + 1)).clone();
}

void SceneRenderer::chooseCloud() {
    cloud_ = view_.keyframe_clouds > 0 ? &keyframe_clouds_ : &map_;
    useful_.clear();
    if (view_.points) useful_ = usefulPoints(cloud_->chunks, view_.camera, size_px_);
    if (view_.keyframe_clouds > 0) useful_.resize(std::min(useful_.size(), view_.keyframe_clouds));
    useful_total_ = std::accumulate(useful_.begin(), useful_.end(), std::size_t{0});
}

Vertices SceneRenderer::shownPoints() const {
    Vertices shown;
    for (std::size_t c = 0; c < useful_.size(); ++c) {
        const PointChunk& chunk = cloud_->chunks[c];
        for (const Vertex& point : cloud_->buffer.read(chunk.first, chunk.count)) {
            if (point.position.z() <= view_.highest_m) shown.push_back(point);
        }
    }
    return shown;
}

void SceneRenderer::learnSpeed(double seconds) {
    const double change = std::clamp(view_.time_s / seconds, 0.7, 1.4);
    points_a_frame_ = std::clamp(change * points_a_frame_, fewest_points, most_points);
    // The gap between the two bounds keeps it from changing to and fro.
    if (points_a_frame_ < fewest_sharp_points) coarse_ = true;
    if (points_a_frame_ > 4 * fewest_sharp_points) coarse_ = false;
}

/** Adds the points up to a share of the useful ones to the picture that is bound. */
void SceneRenderer::drawSlice(double to_share, double density, bool is_last) {
    drawn_->target.bind();
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
    if (is_last) drawFreeSpace();
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
    const double focal_px = OrbitCamera::focalPx(size_px_.y());
    const auto reduction = static_cast<float>(drawn_->reduction);
    surface_.use();
    const Eigen::Matrix4f clip = view_.camera.clipFromWorld(view_.size_px).cast<float>();
    surface_.set("clip_from_world", clip);
    surface_.set("highest", view_.highest_m);
    surface_.set("shade", 1.f);
    surface_.set("alpha", 1.f);
    surface_.set("by_height", view_.color_by_height ? 1 : 0);
    surface_.set("height_range", view_.height_range_m);
    surface_.set("spacing_px", static_cast<float>(1.2 * spacing_m * focal_px / std::sqrt(density)));
    surface_.set("least_px", view_.least_point_px / reduction);
    surface_.set("most_px", most_point_px / reduction);
    glEnable(GL_CLIP_DISTANCE0);
}

void SceneRenderer::drawSolids() {
    prepareSurfaceShader(0, 1);
    if (view_.of(Part::Octree) > 0) drawFaces(occupied_);
    glDisable(GL_CLIP_DISTANCE0);
    surface_.set("shade", 1.f);
    surface_.set("by_height", 0);
    buffer(Part::Grid).bind();
    glDrawArrays(GL_TRIANGLES, 0,
                 static_cast<GLsizei>(std::min(view_.of(Part::Grid), buffer(Part::Grid).size())));
}

void SceneRenderer::drawFaces(const Faces& faces) {
    faces.buffer.bind();
    for (std::size_t direction = 0; direction < 6; ++direction) {
        const std::size_t first = faces.starts[direction];
        surface_.set("shade", face_shades[direction]);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first),
                     static_cast<GLsizei>(faces.starts[direction + 1] - first));
    }
}

/** Like glass, over all that is not transparent. */
void SceneRenderer::drawFreeSpace() {
    if (view_.of(Part::FreeSpace) == 0) return;
    prepareSurfaceShader(0, 1);
    surface_.set("alpha", free_alpha);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    drawFaces(free_);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CLIP_DISTANCE0);
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
    line_.set("alpha", 1.f);
    const Eigen::Matrix4f clip = view_.camera.clipFromWorld(view_.size_px).cast<float>();
    line_.set("clip_from_world", clip);
    const Eigen::Vector2f size_px = view_.size_px.cast<float>();
    line_.set("size_px", size_px);  // so that lines keep their width in the window
    for (const auto& [part, width_px] : line_widths) {
        const std::size_t count = std::min(view_.of(part), buffer(part).size());
        if (count == 0) continue;
        line_.set("width_px", std::max(width_px, static_cast<float>(drawn_->reduction)));
        buffer(part).bind();
        glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(count));
    }
}

}  // namespace rgbd_graphslam
