#include "rgbd_graphslam/synth/renderer.h"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/CSetOfTexturedTriangles.h>
#include <mrpt/opengl/DefaultShaders.h>
#include <mrpt/opengl/opengl_api.h>

#include <mrpt/core/exceptions.h>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/lighting.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFaceCell_m = 0.3;  // light is sampled this densely
constexpr float kNear_m = 0.08f, kFar_m = 60.f;
constexpr double kDepthRange_m = 64;  // of the 24-bit code
constexpr auto kShader = mrpt::opengl::DefaultShaderID::TEXTURED_TRIANGLES_LIGHT;

// The attribute that MRPT calls the normal carries the baked light.
const char* const kVertexShader = R"(#version 300 es
in vec3 position;
in vec2 vertexUV;
in vec3 vertexNormal;
uniform highp mat4 pmv_matrix;
out highp vec2 uv;
out highp vec3 light;
void main() {
    uv = vertexUV;
    light = vertexNormal;
    gl_Position = pmv_matrix * vec4(position, 1.0);
}
)";

const char* const kColorShader = R"(#version 300 es
precision highp float;
uniform sampler2D textureSampler;
in highp vec2 uv;
in highp vec3 light;
out vec4 color;
void main() { color = vec4(texture(textureSampler, uv).rgb * light, 1.0); }
)";

// 1 / gl_FragCoord.w is the depth along the axis, interpolated in full precision. The opacity,
// which is always 1, keeps the compiler from dropping inputs that MRPT insists on.
const char* const kDepthShader = R"(#version 300 es
precision highp float;
uniform sampler2D textureSampler;
in highp vec2 uv;
in highp vec3 light;
out vec4 color;
void main() {
    float code = floor(262144.0 / gl_FragCoord.w + 0.5);
    float high = floor(code / 65536.0);
    float middle = floor(code / 256.0) - high * 256.0;
    float low = code - high * 65536.0 - middle * 256.0;
    color = vec4(high / 255.0, middle / 255.0, low / 255.0,
                 texture(textureSampler, uv).r + light.r < 1.0e9 ? 1.0 : 0.0);
}
)";
// What is called the light is label and mask here, each divided by 255.
const char* const kLabelShader = R"(#version 300 es
precision highp float;
uniform sampler2D textureSampler;
in highp vec2 uv;
in highp vec3 light;
out vec4 color;
void main() {
    color = vec4(light, texture(textureSampler, uv).r < 1.0e9 ? 1.0 : 0.0);
}
)";
constexpr double kDepthStep_m = kDepthRange_m / (1 << 24);

/** Textured triangles whose picture is filtered properly: MRPT loads it without mipmaps, which
 *  aliases so badly at a distance that no feature survives. */
class FilteredTriangles : public mrpt::opengl::CSetOfTexturedTriangles {
  public:
    void initializeTextures() const override {
        CSetOfTexturedTriangles::initializeTextures();
        if (filtered_) return;
        filtered_ = true;
        glGenerateMipmap(GL_TEXTURE_2D);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        // Sharper than one sample a pixel would bear: pictures are averaged from several. Not
        // anisotropic, which takes llvmpipe several seconds for some pictures.
        glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, -0.7f);
    }

  private:
    mutable bool filtered_ = false;
};

mrpt::opengl::Program::Ptr linked(const char* fragment_shader) {
    auto program = std::make_shared<mrpt::opengl::Program>();
    std::vector<mrpt::opengl::Shader> shaders(2);
    if (!shaders[0].compile(GL_VERTEX_SHADER, kVertexShader) ||
        !shaders[1].compile(GL_FRAGMENT_SHADER, fragment_shader) || !program->linkProgram(shaders))
        throw Error("the OpenGL driver does not compile the renderer's shaders",
                    "install Mesa's software renderer (libgl1-mesa-dri)");
    for (const char* name : {"position", "vertexUV", "vertexNormal"})
        program->declareAttribute(name);
    for (const char* name : {"pmv_matrix", "textureSampler"}) program->declareUniform(name);
    return program;
}

mrpt::poses::CPose3D toMrpt(const SE3& T) {
    mrpt::poses::CPose3D pose;
    mrpt::math::CMatrixDouble33 R;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) R(row, column) = T.R(row, column);
    pose.setRotationMatrix(R);
    pose.x(T.t.x());
    pose.y(T.t.y());
    pose.z(T.t.z());
    return pose;
}

/** Cuts faces into cells small enough for light to vary over them, one triangle list a material. */
class Mesher {
  public:
    Mesher(const Scene& scene, const Lighting& lighting, const Eigen::Affine3d& lit_at)
        : scene_(scene), lighting_(lighting), lit_at_(lit_at) {}

    void add(const Quad& quad, std::vector<mrpt::opengl::TTriangle>& triangles) const {
        const auto steps = [](const Vector3d& edge) {
            return std::max(1, static_cast<int>(std::lround(edge.norm() / kFaceCell_m)));
        };
        const int nu = steps(quad.corners[1] - quad.corners[0]);
        const int nv = steps(quad.corners[3] - quad.corners[0]);
        std::vector<Vertex> grid;
        for (int iv = 0; iv <= nv; ++iv)
            for (int iu = 0; iu <= nu; ++iu)
                grid.push_back(
                    vertex(quad, static_cast<double>(iu) / nu, static_cast<double>(iv) / nv));
        for (int iv = 0; iv < nv; ++iv)
            for (int iu = 0; iu < nu; ++iu) {
                const int a = iv * (nu + 1) + iu, b = a + 1, c = b + nu + 1, d = a + nu + 1;
                triangles.push_back(triangle(grid[a], grid[b], grid[c]));
                triangles.push_back(triangle(grid[a], grid[c], grid[d]));
            }
    }

  private:
    using Vertex = mrpt::opengl::TTriangle::Vertex;

    static mrpt::opengl::TTriangle triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
        mrpt::opengl::TTriangle result;
        result.vertices = {a, b, c};
        return result;
    }

    Vertex vertex(const Quad& quad, double u, double v) const {
        const auto blend = [&](const auto& corner) {
            return ((1 - v) * ((1 - u) * corner[0] + u * corner[1]) +
                    v * ((1 - u) * corner[3] + u * corner[2]))
                .eval();
        };
        const Vector3d point = blend(quad.corners);
        const Vector2d uv = blend(quad.uv);
        const Vector3d center =
            0.25 * (quad.corners[0] + quad.corners[1] + quad.corners[2] + quad.corners[3]);
        const Vector3d light = lightAt(quad, point + inwards(center - point));
        Vertex result;
        result.xyzrgba.pt = {static_cast<float>(point.x()), static_cast<float>(point.y()),
                             static_cast<float>(point.z())};
        result.uv = {static_cast<float>(uv.x()), static_cast<float>(uv.y())};
        result.normal = {static_cast<float>(light.z()), static_cast<float>(light.y()),
                         static_cast<float>(light.x())};
        return result;
    }

    /** Away from the rim, where the neighboring face would cover the sample. */
    static Vector3d inwards(const Vector3d& to_center) {
        const double distance = to_center.norm();
        return distance < 1e-9 ? to_center : to_center * std::min(1.0, 0.08 / distance);
    }

    Vector3d lightAt(const Quad& quad, const Vector3d& point) const {
        const double glow = scene_.materials[quad.material].glow;
        const Vector3d light = lighting_.at(lit_at_ * point, lit_at_.linear() * quad.normal());
        return Vector3d::Constant(glow) + (1 - glow) * light;
    }

    const Scene& scene_;
    const Lighting& lighting_;
    const Eigen::Affine3d lit_at_;
};

std::shared_ptr<FilteredTriangles> toObject(const Material& material,
                                            const std::vector<mrpt::opengl::TTriangle>& triangles) {
    auto object = std::make_shared<FilteredTriangles>();
    object->assignImage(mrpt::img::CImage(material.image, mrpt::img::DEEP_COPY));
    object->enableTextureLinearInterpolation(true);
    for (const auto& triangle : triangles) object->insertTriangle(triangle);
    return object;
}
/** Faces whose vertices carry label and mask. */
std::shared_ptr<FilteredTriangles> toLabels(const std::vector<Quad>& quads, bool masked) {
    std::vector<mrpt::opengl::TTriangle> triangles;
    for (const Quad& quad : quads) {
        std::array<mrpt::opengl::TTriangle::Vertex, 4> vertices;
        for (int i = 0; i < 4; ++i) {
            const Eigen::Vector3f at = quad.corners[i].cast<float>();
            vertices[i].xyzrgba.pt = {at.x(), at.y(), at.z()};
            vertices[i].normal = {static_cast<float>(quad.label) / 255, masked ? 1.f : 0.f, 0};
        }
        for (int last : {2, 3}) {
            triangles.emplace_back();
            triangles.back().vertices = {vertices[0], vertices[last - 1], vertices[last]};
        }
    }
    return toObject({cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(0))}, triangles);
}

using Objects = std::vector<mrpt::opengl::CRenderizable::Ptr>;

void prepare(mrpt::opengl::COpenGLScene& scene) {
    const auto view = scene.getViewport();
    view->setViewportClipDistances(kNear_m, kFar_m);
    view->setCustomBackgroundColor({0, 0, 0, 0});
    view->loadDefaultShaders();
}
}  // namespace

struct Renderer::Impl {
    Impl(const Scene& scene, const Camera& camera);
    Objects addQuads(const Scene& scene, const Lighting& lighting, const MovingBody& body);
    void addLabels(const Scene& scene);
    cv::Mat draw(mrpt::opengl::COpenGLScene& scene, const SE3& T_world_cam,
                 const Vector2d& shift_px, const mrpt::opengl::Program::Ptr& program);

    Camera camera_;
    mrpt::opengl::CFBORender buffer_;
    mrpt::opengl::COpenGLScene scene_, label_scene_;
    std::vector<Objects> figures_;  // of both scenes
    mrpt::opengl::Program::Ptr color_, depth_, label_;
    mrpt::img::CImage picture_;
};

Renderer::Impl::Impl(const Scene& scene, const Camera& camera)
    : camera_(camera), buffer_(camera.width, camera.height) {
    prepare(scene_);
    prepare(label_scene_);
    color_ = linked(kColorShader);
    depth_ = linked(kDepthShader);
    label_ = linked(kLabelShader);

    const Lighting lighting(scene);
    addQuads(scene, lighting, {scene.quads});
    for (const MovingBody& figure : scene.figures)
        figures_.push_back(addQuads(scene, lighting, figure));
    addLabels(scene);
}

Objects Renderer::Impl::addQuads(const Scene& scene, const Lighting& lighting,
                                 const MovingBody& body) {
    std::vector<std::vector<mrpt::opengl::TTriangle>> triangles(scene.materials.size());
    const Mesher mesher(scene, lighting, body.lit_at);
    for (const Quad& quad : body.quads) mesher.add(quad, triangles[quad.material]);
    Objects objects;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i].empty()) continue;
        objects.push_back(toObject(scene.materials[i], triangles[i]));
        scene_.getViewport()->insert(objects.back());
    }
    return objects;
}

void Renderer::Impl::addLabels(const Scene& scene) {
    label_scene_.getViewport()->insert(toLabels(scene.quads, false));
    for (std::size_t i = 0; i < figures_.size(); ++i) {
        figures_[i].push_back(toLabels(scene.figures[i].quads, true));
        label_scene_.getViewport()->insert(figures_[i].back());
    }
}

cv::Mat Renderer::Impl::draw(mrpt::opengl::COpenGLScene& scene, const SE3& T_world_cam,
                             const Vector2d& shift_px, const mrpt::opengl::Program::Ptr& program) {
    mrpt::img::TCamera intrinsics;
    intrinsics.ncols = camera_.width;
    intrinsics.nrows = camera_.height;
    // OpenGL's pixel centers are at halves, ours at whole numbers.
    const Intrinsics own = camera_.intrinsics();
    intrinsics.setIntrinsicParamsFromValues(own.fx, own.fy, own.cx + 0.5 + shift_px.x(),
                                            own.cy + 0.5 + shift_px.y());
    mrpt::opengl::CCamera eye;
    eye.set6DOFMode(true);
    eye.setProjectiveFromPinhole(intrinsics);
    eye.setPose(toMrpt(T_world_cam));
    buffer_.setCamera(scene, eye);
    scene.getViewport()->shaders()[kShader] = program;
    buffer_.render_RGB(scene, picture_);
    return picture_.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
}

Renderer::Renderer(const Scene& scene, const Camera& camera) {
    if (camera.hasDistortion()) throw Error("the renderer has no lens distortion");
    try {
        impl_ = std::make_unique<Impl>(scene, camera);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& failure) {
        throw Error(
            "cannot render off-screen (" + mrpt::exception_to_str(failure).substr(0, 120) + ")",
            "install Mesa's software renderer (libegl-mesa0, libgl1-mesa-dri)");
    }
}

Renderer::~Renderer() = default;

void Renderer::placeFigure(int index, const SE3& T_world_figure) {
    for (const auto& object : impl_->figures_.at(index)) object->setPose(toMrpt(T_world_figure));
}

cv::Mat Renderer::color(const SE3& T_world_cam, const Vector2d& shift_px) {
    return impl_->draw(impl_->scene_, T_world_cam, shift_px, impl_->color_).clone();
}

cv::Mat Renderer::depth(const SE3& T_world_cam, const Vector2d& shift_px) {
    const cv::Mat coded = impl_->draw(impl_->scene_, T_world_cam, shift_px, impl_->depth_);
    cv::Mat depth(coded.size(), CV_32FC1);
    for (int v = 0; v < coded.rows; ++v) {
        const auto* from = coded.ptr<cv::Vec3b>(v);
        auto* to = depth.ptr<float>(v);
        for (int u = 0; u < coded.cols; ++u)
            to[u] = static_cast<float>(kDepthStep_m *
                                       ((from[u][2] << 16) + (from[u][1] << 8) + from[u][0]));
    }
    return depth;
}

LabelPicture Renderer::labels(const SE3& T_world_cam) {
    const cv::Mat coded = impl_->draw(impl_->label_scene_, T_world_cam, {0, 0}, impl_->label_);
    LabelPicture picture;
    cv::extractChannel(coded, picture.label, 2);
    cv::extractChannel(coded, picture.mask, 1);
    return picture;
}

}  // namespace rgbd_graphslam::synth
