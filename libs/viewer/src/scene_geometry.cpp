#include "scene_geometry.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/mapping/height_colors.h"
#include "shaders.h"

namespace rgbd_graphslam {
namespace {

constexpr float most_point_px = 12, free_alpha = 0.08f;
/** How bright the octree's sides are: -x, +x, -y, +y, -z, +z. */
constexpr float face_shades[] = {0.75f, 0.85f, 0.7f, 0.8f, 0.55f, 1.f};

struct LineWidth {
    Part part;
    float px;
};
constexpr LineWidth scene_lines[] = {
    {Part::Floor, 1},     {Part::BeforeLoops, 1.5f}, {Part::Covisibility, 1}, {Part::Errors, 1},
    {Part::Keyframes, 1}, {Part::TruePath, 2},       {Part::Path, 2.5f},      {Part::Loops, 2.5f}};
/** Never hidden by what is in front of them. */
constexpr LineWidth marks[] = {{Part::NowCamera, 3}, {Part::Selection, 3}, {Part::Measure, 3}};

void drawRanges(const std::vector<DrawRange>& ranges) {
    std::vector<GLint> firsts;
    std::vector<GLsizei> counts;
    for (const DrawRange& range : ranges) {
        firsts.push_back(static_cast<GLint>(range.first));
        counts.push_back(static_cast<GLsizei>(range.count));
    }
    glMultiDrawArrays(GL_POINTS, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
}

void clear() {
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(background_color[0] / 255.f, background_color[1] / 255.f,
                 background_color[2] / 255.f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/** For the shader. */
std::vector<float> paletteValues() {
    static_assert(height_palette_size == 32, "the shader's palette has as many colors");
    std::vector<float> values;
    for (const Rgba& color : heightPalette())
        for (const int c : {0, 1, 2}) values.push_back(static_cast<float>(color[c]) / 255);
    return values;
}

Eigen::Matrix4f clipFromWorld(const SceneView& view) {
    return view.camera.clipFromWorld(view.size_px).cast<float>();
}

}  // namespace

SceneGeometry::SceneGeometry()
    : surface_(surface_vertex_shader, "", surface_fragment_shader),
      line_(line_vertex_shader, line_geometry_shader, surface_fragment_shader) {
    surface_.use();
    surface_.setColors("palette", paletteValues());
}

void SceneGeometry::Faces::set(const std::array<Vertices, 6>& faces) {
    Vertices all;
    for (std::size_t direction = 0; direction < faces.size(); ++direction) {
        starts[direction] = all.size();
        all.insert(all.end(), faces[direction].begin(), faces[direction].end());
    }
    starts[6] = all.size();
    buffer.set(all);
}

void SceneGeometry::setMesh(const Vertices& vertices, const Triangles& triangles,
                            const Triangles& fewer) {
    buffer(Part::Mesh).set(vertices);
    mesh_triangles_.set(triangles);
    fewer_triangles_.set(fewer);
}

void SceneGeometry::drawFirst(const Canvas& canvas) {
    clear();
    drawSolids(canvas);
    for (const auto& [part, width_px] : scene_lines) drawLines(canvas, part, width_px);
}

void SceneGeometry::prepareSurfaceShader(const Canvas& canvas) {
    const SceneView& view = canvas.view;
    surface_.use();
    surface_.set("clip_from_world", clipFromWorld(view));
    surface_.set("highest", view.highest_m);
    surface_.set("shade", 1.f);
    surface_.set("alpha", 1.f);
    surface_.set("by_height", view.color_by_height ? 1 : 0);
    surface_.set("height_range", view.height_range_m);
    glEnable(GL_CLIP_DISTANCE0);
}

void SceneGeometry::drawSolids(const Canvas& canvas) {
    prepareSurfaceShader(canvas);
    if (canvas.view.of(Part::Mesh) > 0)
        (canvas.moving ? fewer_triangles_ : mesh_triangles_).draw(buffer(Part::Mesh));
    if (canvas.view.of(Part::Octree) > 0) drawFaces(occupied_);
    glDisable(GL_CLIP_DISTANCE0);
    surface_.set("shade", 1.f);
    surface_.set("by_height", 0);
    const VertexBuffer& grid = buffer(Part::Grid);
    grid.bind();
    glDrawArrays(GL_TRIANGLES, 0,
                 static_cast<GLsizei>(std::min(canvas.view.of(Part::Grid), grid.size())));
}

void SceneGeometry::drawFaces(const Faces& faces) {
    faces.buffer.bind();
    for (std::size_t direction = 0; direction < 6; ++direction) {
        const std::size_t first = faces.starts[direction];
        surface_.set("shade", face_shades[direction]);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first),
                     static_cast<GLsizei>(faces.starts[direction + 1] - first));
    }
}

void SceneGeometry::drawLast(const Canvas& canvas) {
    if (canvas.view.of(Part::FreeSpace) > 0) drawFreeSpace(canvas);
    glDisable(GL_DEPTH_TEST);
    for (const auto& [part, width_px] : marks) drawLines(canvas, part, width_px);
}

void SceneGeometry::drawFreeSpace(const Canvas& canvas) {
    prepareSurfaceShader(canvas);
    surface_.set("alpha", free_alpha);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    drawFaces(free_);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CLIP_DISTANCE0);
}

void SceneGeometry::drawPoints(const Canvas& canvas, const VertexBuffer& points,
                               const std::vector<DrawRange>& ranges, float spacing_m,
                               double density) {
    const double focal_px = OrbitCamera::focalPx(canvas.size_px.y());
    const auto reduction = static_cast<float>(canvas.reduction);
    prepareSurfaceShader(canvas);
    surface_.set("spacing_px", static_cast<float>(1.2 * spacing_m * focal_px / std::sqrt(density)));
    surface_.set("least_px", canvas.view.least_point_px / reduction);
    surface_.set("most_px", most_point_px / reduction);
    points.bind();
    drawRanges(ranges);
    glDisable(GL_CLIP_DISTANCE0);
}

void SceneGeometry::drawLines(const Canvas& canvas, Part part, float width_px) {
    const SceneView& view = canvas.view;
    const std::size_t count = std::min(view.of(part), buffer(part).size());
    if (count == 0) return;
    line_.use();
    line_.set("alpha", 1.f);
    line_.set("clip_from_world", clipFromWorld(view));
    const Eigen::Vector2f size_px = view.size_px.cast<float>();
    line_.set("size_px", size_px);  // so that lines keep their width in the window
    line_.set("width_px", std::max(width_px, static_cast<float>(canvas.reduction)));
    buffer(part).bind();
    glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(count));
}

}  // namespace rgbd_graphslam
