#include "rgbd_graphslam/viewer/snapshot.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/framing.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/mapping/orbit_camera.h"
#include "rgbd_graphslam/mapping/picture_marks.h"
#include "rgbd_graphslam/viewer/scene_parts.h"

namespace rgbd_graphslam {
namespace {

using mrpt::opengl::COpenGLScene;
using mrpt::opengl::CPointCloudColoured;
using mrpt::opengl::CSetOfLines;

constexpr int oversampling = 2;  // rendered larger, then reduced, for smooth edges
constexpr float point_spacing_m = 0.012f;
constexpr double degree = M_PI / 180;

struct LineColor {
    const char* name;
    Rgba color;
};
constexpr LineColor line_colors[] = {{scene_names::graph_before_loops, before_color},
                                     {scene_names::trajectory, trajectory_color},
                                     {scene_names::keyframes, keyframe_color},
                                     {scene_names::loops, loop_color}};

template <class Object>
typename Object::Ptr objectNamed(const COpenGLScene& scene, const char* name) {
    return std::dynamic_pointer_cast<Object>(scene.getViewport()->getByName(name));
}

Eigen::Vector3d vectorOf(const mrpt::math::TPoint3D& p) {
    return {p.x, p.y, p.z};
}

/** Positions along the trajectory's lines. */
Trajectory pathOf(const COpenGLScene& scene) {
    Trajectory path;
    if (const auto lines = objectNamed<CSetOfLines>(scene, scene_names::trajectory)) {
        for (const auto& line : *lines)
            path.push_back({0, {Eigen::Matrix3d::Identity(), vectorOf(line.point2)}});
    }
    return path;
}

/** Places and directions of view, from the frustums: of their eight lines the first and then every
 *  second one go from the eye to a corner. */
Trajectory viewsOf(const COpenGLScene& scene) {
    constexpr std::size_t lines_a_frustum = 8;
    Trajectory views;
    const auto lines = objectNamed<CSetOfLines>(scene, scene_names::keyframes);
    for (std::size_t f = 0; lines && f + lines_a_frustum <= lines->getLineCount();
         f += lines_a_frustum) {
        const Eigen::Vector3d eye = vectorOf((*(lines->begin() + static_cast<long>(f))).point1);
        Eigen::Vector3d forward = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < lines_a_frustum; i += 2)
            forward += vectorOf((*(lines->begin() + static_cast<long>(f + i))).point2) - eye;
        views.push_back(
            {0, {Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), forward), eye}});
    }
    return views;
}

CPointCloudColoured::Ptr pointsBelow(const CPointCloudColoured& points, float ceiling_m) {
    auto kept = CPointCloudColoured::Create();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& p = points.getPoint3Df(i);
        if (p.z > ceiling_m) continue;
        float r = 0, g = 0, b = 0;
        points.getPointColor_fast(i, r, g, b);
        kept->push_back(p.x, p.y, p.z, r, g, b);
    }
    kept->enableVariablePointSize(false);
    return kept;
}

/** Those of a mesh: what frames the picture. */
CPointCloudColoured::Ptr verticesBelow(const PlyModel& mesh, float ceiling_m) {
    auto kept = CPointCloudColoured::Create();
    for (const Eigen::Vector3f& p : mesh.vertices)
        if (p.z() <= ceiling_m) kept->push_back(p.x(), p.y(), p.z(), 0, 0, 0);
    return kept;
}

/** Lit as in the window. */
mrpt::opengl::CSetOfTriangles::Ptr trianglesBelow(const PlyModel& mesh, float ceiling_m) {
    const Vertices vertices = meshVertices(mesh);
    auto object = mrpt::opengl::CSetOfTriangles::Create();
    object->enableLight(false);
    for (const auto& corners : mesh.triangles) {
        mrpt::opengl::TTriangle triangle;
        bool below = true;
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3f& p = vertices[corners[i]].position;
            const Rgba& color = vertices[corners[i]].color;
            below &= p.z() <= ceiling_m;
            const auto lit = [&](int channel) {
                return static_cast<std::uint8_t>(color[channel] * color[3] / 255);
            };
            triangle.vertices[i].xyzrgba.pt = {p.x(), p.y(), p.z()};
            triangle.vertices[i].setColor(mrpt::img::TColor(lit(0), lit(1), lit(2)));
        }
        if (below) object->insertTriangle(triangle);
    }
    return object;
}

/** Opposite corners of all that is in a scene of other programs. */
std::vector<Eigen::Vector3d> endsOf(const COpenGLScene& scene) {
    try {
        const auto whole = scene.getBoundingBox();
        return {vectorOf(whole.min), vectorOf(whole.max)};
    } catch (const std::exception&) {  // MRPT has no box of nothing
        return {{-1, -1, 0}, {1, 1, 1}};
    }
}

Framing frameOf(const COpenGLScene& scene, const CPointCloudColoured& points) {
    PointMap map;
    map.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& p = points.getPoint3Df(i);
        map.push_back({{p.x, p.y, p.z}, {}});
    }
    Framing framing = framingOf(map, viewsOf(scene), pathOf(scene));
    if (!framing.box.isEmpty()) return framing;
    framing.points = endsOf(scene);
    return framing;
}

/** The lines that the scene has. */
std::optional<FloorGrid> floorOf(const COpenGLScene& scene) {
    const auto floor = objectNamed<mrpt::opengl::CGridPlaneXY>(scene, scene_names::floor);
    if (!floor) return std::nullopt;
    float x_min = 0, x_max = 0, y_min = 0, y_max = 0;
    floor->getPlaneLimits(x_min, x_max, y_min, y_max);
    return FloorGrid{x_min, x_max, y_min, y_max, floor->getGridFrequency()};
}

OrbitCamera cameraFor(const Framing& framing, const ViewOptions& options) {
    constexpr double least_distance_m = 0.2;
    OrbitCamera camera;
    camera.azimuth_rad = degree * options.azimuth_deg;
    camera.elevation_rad = degree * options.elevation_deg;
    camera.frame(framing.points, {options.width_px, options.height_px});
    camera.distance_m = std::max(least_distance_m, camera.distance_m / options.zoom);
    return camera;
}

mrpt::opengl::CCamera mrptCamera(const OrbitCamera& camera, const ViewOptions& options) {
    mrpt::opengl::CCamera same;
    const Eigen::Vector3f target = camera.target.cast<float>();
    same.setProjectiveModel(true);
    same.setProjectiveFOVdeg(static_cast<float>(OrbitCamera::field_of_view_rad / degree));
    same.setPointingAt(target.x(), target.y(), target.z());
    same.setZoomDistance(static_cast<float>(camera.distance_m));
    same.setAzimuthDegrees(static_cast<float>(options.azimuth_deg));
    same.setElevationDegrees(static_cast<float>(options.elevation_deg));
    return same;
}

/** Lines as rows of dots: drivers draw all lines one pixel wide. \param spacing_m between dots */
CPointCloudColoured::Ptr dotted(const CSetOfLines& lines, const Rgba& rgba, double spacing_m) {
    auto dots = CPointCloudColoured::Create();
    const mrpt::img::TColorf color(mrpt::img::TColor(rgba[0], rgba[1], rgba[2]));
    for (const auto& line : lines) {
        const auto along = line.point2 - line.point1;
        const int count = 1 + static_cast<int>(along.norm() / spacing_m);
        for (int i = 0; i <= count; ++i) {
            const auto p = line.point1 + (static_cast<double>(i) / count) * along;
            dots->push_back(static_cast<float>(p.x), static_cast<float>(p.y),
                            static_cast<float>(p.z), color.R, color.G, color.B);
        }
    }
    dots->enableVariablePointSize(false);
    dots->setPointSize(oversampling * lines.getLineWidth());
    return dots;
}

void replace(COpenGLScene& scene, const mrpt::opengl::CRenderizable::Ptr& old,
             const mrpt::opengl::CRenderizable::Ptr& by) {
    if (old) scene.removeObject(old);
    scene.insert(by);
}

/** A shallow copy with something else for points, and lines of the width they ask for. */
COpenGLScene restyled(const COpenGLScene& scene, const mrpt::opengl::CRenderizable::Ptr& points,
                      double pixel_m) {
    COpenGLScene copy = scene;
    copy.getViewport()->setCustomBackgroundColor(mrpt::img::TColorf(
        mrpt::img::TColor(background_color[0], background_color[1], background_color[2])));
    replace(copy, copy.getViewport()->getByName(scene_names::points), points);
    for (const auto& [name, color] : line_colors) {
        if (const auto lines = objectNamed<CSetOfLines>(copy, name))
            replace(copy, lines, dotted(*lines, color, pixel_m));
    }
    return copy;
}

cv::Mat3b rendered(const COpenGLScene& scene, const mrpt::opengl::CCamera& camera,
                   const ViewOptions& options) {
    mrpt::img::CImage image;
    try {
        mrpt::opengl::CFBORender renderer(static_cast<unsigned>(oversampling * options.width_px),
                                          static_cast<unsigned>(oversampling * options.height_px));
        renderer.setCamera(scene, camera);
        renderer.render_RGB(scene, image);
    } catch (const std::exception&) {
        throw Error("this machine cannot render off-screen (no EGL)",
                    "install Debian's libegl-mesa0 and libgl1-mesa-dri");
    }
    cv::Mat3b smooth;
    cv::resize(image.asCvMatRef(), smooth, cv::Size(options.width_px, options.height_px), 0, 0,
               cv::INTER_AREA);
    return smooth;
}

}  // namespace

COpenGLScene loadScene(const std::string& path) {
    if (!std::filesystem::is_regular_file(path)) {
        throw Error("cannot read '" + path + "'",
                    "give the output folder of rgbd-slam or rgbd-map");
    }
    try {
        mrpt::io::CFileGZInputStream in(path);
        COpenGLScene scene;
        auto archive = mrpt::serialization::archiveFrom(in);
        archive >> scene;
        return scene;
    } catch (const std::exception&) {
        throw Error("'" + path + "' is cut off or no 3-D scene", "write it again with rgbd-map");
    }
}

void renderSnapshot(const COpenGLScene& scene, const ViewOptions& options,
                    const std::string& png_path, const PlyModel& mesh) {
    const float highest_m =
        options.cut_ceiling ? static_cast<float>(ceilingCut(pathOf(scene))) : INFINITY;
    const bool as_mesh = !mesh.triangles.empty();
    const auto all = objectNamed<CPointCloudColoured>(scene, scene_names::points);
    const auto points = as_mesh ? verticesBelow(mesh, highest_m)
                        : all   ? pointsBelow(*all, highest_m)
                                : CPointCloudColoured::Create();
    const OrbitCamera camera = cameraFor(frameOf(scene, *points), options);
    const double pixel_m =
        camera.distance_m / OrbitCamera::focalPx(oversampling * options.height_px);
    // So that points of the usual spacing close up to a surface.
    points->setPointSize(
        std::clamp(1.2f * point_spacing_m / static_cast<float>(pixel_m), 2.f, 16.f));
    mrpt::opengl::CRenderizable::Ptr surface = points;
    if (as_mesh) surface = trianglesBelow(mesh, highest_m);
    cv::Mat3b picture =
        rendered(restyled(scene, surface, pixel_m), mrptCamera(camera, options), options);
    if (const auto floor = floorOf(scene))
        drawLabels(picture, floorLabels(*floor, camera, {picture.cols, picture.rows}));
    drawScaleBar(picture, oversampling * pixel_m);
    writeAtomically(png_path,
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
}

}  // namespace rgbd_graphslam
