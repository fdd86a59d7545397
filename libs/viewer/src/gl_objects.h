/** OpenGL objects that free themselves. All need their context current. */
#pragma once
#include <nanogui/opengl.h>

#include <Eigen/Core>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Vertices in graphics memory. */
class VertexBuffer {
  public:
    VertexBuffer();
    ~VertexBuffer();
    VertexBuffer(const VertexBuffer&) = delete;
    VertexBuffer& operator=(const VertexBuffer&) = delete;

    /** Takes the place of all that was there. */
    void set(const Vertices& vertices);
    /** Writes from position `first` on; what is there before stays. */
    void write(std::size_t first, const Vertices& vertices);
    std::size_t size() const { return size_; }
    /** Slow: they come back from graphics memory. */
    Vertices read(std::size_t first, std::size_t count) const;
    /** For the draw calls that follow. */
    void bind() const { glBindVertexArray(array_); }

  private:
    void reserve(std::size_t capacity);
    void attach();

    GLuint array_ = 0, buffer_ = 0;
    std::size_t size_ = 0, capacity_ = 0;
};

/** Triangles between vertices of a VertexBuffer. */
class IndexBuffer {
  public:
    IndexBuffer() { glGenBuffers(1, &buffer_); }
    ~IndexBuffer() { glDeleteBuffers(1, &buffer_); }
    IndexBuffer(const IndexBuffer&) = delete;
    IndexBuffer& operator=(const IndexBuffer&) = delete;

    void set(const Triangles& triangles);
    void draw(const VertexBuffer& vertices) const;

  private:
    GLuint buffer_ = 0;
    std::size_t triangles_ = 0;
};

/** A linked set of shaders. */
class ShaderProgram {
  public:
    /** \param geometry may be empty \throws Error with the compiler's words */
    ShaderProgram(const char* vertex, const char* geometry, const char* fragment);
    ~ShaderProgram() { glDeleteProgram(program_); }
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    void use() const { glUseProgram(program_); }
    void set(const char* name, float value) { glUniform1f(at(name), value); }
    void set(const char* name, int value) { glUniform1i(at(name), value); }
    void set(const char* name, const Eigen::Vector2f& v) { glUniform2f(at(name), v.x(), v.y()); }
    void set(const char* name, const Eigen::Matrix4f& m) {
        glUniformMatrix4fv(at(name), 1, GL_FALSE, m.data());
    }
    /** \param colors red, green and blue of each, 0 to 1 */
    void setColors(const char* name, const std::vector<float>& colors) {
        glUniform3fv(at(name), static_cast<GLsizei>(colors.size() / 3), colors.data());
    }

  private:
    GLint at(const char* name);

    GLuint program_ = 0;
    std::map<std::string, GLint> places_;
};

/** A picture with depth and stencil that is drawn out of sight. */
class RenderTarget {
  public:
    RenderTarget();
    ~RenderTarget();
    RenderTarget(const RenderTarget&) = delete;
    RenderTarget& operator=(const RenderTarget&) = delete;

    /** Does nothing when the size stays. */
    void resize(const Eigen::Vector2i& size_px);
    void bind() const;
    /** Copies the colors to the window's back buffer, as large as that is.
     *  \param area of the window, in pixels from its top-left corner */
    void copyToWindow(const cv::Rect& area, const Eigen::Vector2i& window_px) const;
    /** OpenGL depths of the square around a pixel, counted from the top; 1 outside. */
    cv::Mat1f depthsAround(const Eigen::Vector2i& pixel, int radius_px) const;

  private:
    Eigen::Vector2i size_px_ = Eigen::Vector2i::Zero();
    GLuint frame_ = 0, color_ = 0, depth_ = 0;
};

}  // namespace rgbd_graphslam
