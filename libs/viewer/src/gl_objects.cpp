#include "gl_objects.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr GLuint position_attribute = 0, color_attribute = 1;

GLuint compiled(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    char log[512] = {};
    glGetShaderInfoLog(shader, sizeof(log), nullptr, log);
    throw Error("the graphics driver refuses a shader: " + std::string(log),
                "try LIBGL_ALWAYS_SOFTWARE=1, or --snapshot");
}

GLsizeiptr bytesOf(std::size_t vertices) {
    return static_cast<GLsizeiptr>(vertices * sizeof(Vertex));
}

}  // namespace

VertexBuffer::VertexBuffer() {
    glGenVertexArrays(1, &array_);
}

VertexBuffer::~VertexBuffer() {
    glDeleteBuffers(1, &buffer_);
    glDeleteVertexArrays(1, &array_);
}

void VertexBuffer::set(const Vertices& vertices) {
    size_ = 0;
    write(0, vertices);
}

void VertexBuffer::write(std::size_t first, const Vertices& vertices) {
    if (vertices.empty()) return;
    const std::size_t end = first + vertices.size();
    if (end > capacity_) reserve(size_ == 0 ? end : std::max(end, 2 * capacity_));
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferSubData(GL_ARRAY_BUFFER, bytesOf(first), bytesOf(vertices.size()), vertices.data());
    size_ = std::max(size_, end);
}

Vertices VertexBuffer::read(std::size_t first, std::size_t count) const {
    Vertices vertices(count);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glGetBufferSubData(GL_ARRAY_BUFFER, bytesOf(first), bytesOf(count), vertices.data());
    return vertices;
}

void VertexBuffer::reserve(std::size_t capacity) {
    GLuint larger = 0;
    glGenBuffers(1, &larger);
    glBindBuffer(GL_ARRAY_BUFFER, larger);
    glBufferData(GL_ARRAY_BUFFER, bytesOf(capacity), nullptr, GL_DYNAMIC_DRAW);
    if (size_ > 0) {
        glBindBuffer(GL_COPY_READ_BUFFER, buffer_);
        glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_ARRAY_BUFFER, 0, 0, bytesOf(size_));
    }
    glDeleteBuffers(1, &buffer_);
    buffer_ = larger;
    capacity_ = capacity;
    attach();
}

void VertexBuffer::attach() {
    bind();
    glEnableVertexAttribArray(position_attribute);
    glVertexAttribPointer(position_attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
    glEnableVertexAttribArray(color_attribute);
    // OpenGL takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* color_offset = reinterpret_cast<const void*>(offsetof(Vertex, color));
    glVertexAttribPointer(color_attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                          color_offset);
    glBindVertexArray(0);
}

void IndexBuffer::set(const Triangles& triangles) {
    // Not as GL_ELEMENT_ARRAY_BUFFER, which would bind it to whatever vertices are bound.
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer_);
    glBufferData(GL_COPY_WRITE_BUFFER,
                 static_cast<GLsizeiptr>(triangles.size() * sizeof(triangles[0])), triangles.data(),
                 GL_STATIC_DRAW);
    triangles_ = triangles.size();
}

void IndexBuffer::draw(const VertexBuffer& vertices) const {
    vertices.bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles_), GL_UNSIGNED_INT, nullptr);
}

ShaderProgram::ShaderProgram(const char* vertex, const char* geometry, const char* fragment)
    : program_(glCreateProgram()) {
    const auto add = [&](GLenum kind, const char* source) {
        const GLuint shader = compiled(kind, source);
        glAttachShader(program_, shader);
        glDeleteShader(shader);
    };
    add(GL_VERTEX_SHADER, vertex);
    if (*geometry) add(GL_GEOMETRY_SHADER, geometry);
    add(GL_FRAGMENT_SHADER, fragment);
    glBindAttribLocation(program_, position_attribute, "position");
    glBindAttribLocation(program_, color_attribute, "color");
    glLinkProgram(program_);
    GLint ok = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &ok);
    if (!ok) throw Error("the graphics driver cannot link our shaders", "use --snapshot");
}

GLint ShaderProgram::at(const char* name) {
    const auto [place, is_new] = places_.emplace(name, 0);
    if (is_new) place->second = glGetUniformLocation(program_, name);
    return place->second;
}

RenderTarget::RenderTarget() {
    glGenFramebuffers(1, &frame_);
    glGenRenderbuffers(1, &color_);
    glGenRenderbuffers(1, &depth_);
}

RenderTarget::~RenderTarget() {
    glDeleteRenderbuffers(1, &depth_);
    glDeleteRenderbuffers(1, &color_);
    glDeleteFramebuffers(1, &frame_);
}

void RenderTarget::resize(const Eigen::Vector2i& size_px) {
    if (size_px == size_px_) return;
    size_px_ = size_px;
    glBindRenderbuffer(GL_RENDERBUFFER, color_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size_px.x(), size_px.y());
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, size_px.x(), size_px.y());
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glViewport(0, 0, size_px_.x(), size_px_.y());
}

void RenderTarget::copyToWindow(const cv::Rect& area, const Eigen::Vector2i& window_px) const {
    const int left = area.x, right = area.x + area.width;
    const int top = window_px.y() - area.y, bottom = top - area.height;
    const auto x = [&](int window_x) { return window_x * size_px_.x() / window_px.x(); };
    const auto y = [&](int window_y) { return window_y * size_px_.y() / window_px.y(); };
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(x(left), y(bottom), x(right), y(top), left, bottom, right, top,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

cv::Mat1f RenderTarget::depthsAround(const Eigen::Vector2i& pixel, int radius_px) const {
    const int side = 2 * radius_px + 1;
    cv::Mat1f depths(side, side, 1.f);
    const cv::Rect wanted(pixel.x() - radius_px, pixel.y() - radius_px, side, side);
    const cv::Rect there = wanted & cv::Rect(0, 0, size_px_.x(), size_px_.y());
    if (there.empty()) return depths;
    cv::Mat1f read(there.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(there.x, size_px_.y() - there.br().y, there.width, there.height,
                 GL_DEPTH_COMPONENT, GL_FLOAT, read.data);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    cv::flip(read, read, 0);
    read.copyTo(depths(there - wanted.tl()));
    return depths;
}

}  // namespace rgbd_graphslam
