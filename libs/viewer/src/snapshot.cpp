#include "rgbd_graphslam/viewer/snapshot.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_scene.h"
#include "rgbd_graphslam/viewer/scene_parts.h"

namespace rgbd_graphslam {
namespace {

using mrpt::opengl::COpenGLScene;
using mrpt::opengl::CPointCloudColoured;
using mrpt::opengl::CSetOfLines;

constexpr int oversampling = 2;  // rendered larger, then reduced, for smooth edges
constexpr double field_of_view_deg = 40;
constexpr float lowest_ceiling_m = 2, point_spacing_m = 0.012f;
constexpr float outliers = 0.005f;

template <class Object>
typename Object::Ptr objectNamed(const COpenGLScene& scene, const char* name) {
    return std::dynamic_pointer_cast<Object>(scene.getViewport()->getByName(name));
}

float ceilingOf(const COpenGLScene& scene) {
    const auto path = objectNamed<CSetOfLines>(scene, scene_names::trajectory);
    const bool any = path && path->getLineCount() > 0;
    return any ? std::max(lowest_ceiling_m, static_cast<float>(path->getBoundingBox().max.z) + 0.1f)
               : lowest_ceiling_m;
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

/** The box of all but a few stray points, grown by the paths. */
mrpt::math::TBoundingBox frameOf(const COpenGLScene& scene, const CPointCloudColoured& points) {
    std::array<std::vector<float>, 3> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& p = points.getPoint3Df(i);
        for (int axis = 0; axis < 3; ++axis) values[axis].push_back(p[axis]);
    }
    auto box = mrpt::math::TBoundingBox::PlusMinusInfinity();
    const auto quantile = [](std::vector<float>& v, float share) {
        const auto nth =
            v.begin() + static_cast<std::ptrdiff_t>(share * static_cast<float>(v.size() - 1));
        std::nth_element(v.begin(), nth, v.end());
        return *nth;
    };
    for (int axis = 0; axis < 3 && !values[axis].empty(); ++axis) {
        box.min[axis] = quantile(values[axis], outliers);
        box.max[axis] = quantile(values[axis], 1 - outliers);
    }
    const auto path = objectNamed<CSetOfLines>(scene, scene_names::keyframes);
    if (path && path->getLineCount() > 0) box = box.unionWith(path->getBoundingBox());
    if (points.empty() && !path) box = scene.getBoundingBox();
    return box;
}

void aim(mrpt::opengl::CCamera& camera, const mrpt::math::TBoundingBox& box,
         const ViewOptions& options) {
    const auto center = 0.5 * (box.min + box.max);
    const double radius = std::max(0.5 * (box.max - box.min).norm(), 0.2);
    camera.setProjectiveModel(true);
    camera.setProjectiveFOVdeg(field_of_view_deg);
    camera.setPointingAt(static_cast<float>(center.x), static_cast<float>(center.y),
                         static_cast<float>(center.z));
    // The ball around the box would leave much paper empty: boxes are flat and seen obliquely.
    constexpr double fill = 0.8;
    const double distance =
        fill * radius / std::sin(0.5 * field_of_view_deg * M_PI / 180) / options.zoom;
    camera.setZoomDistance(static_cast<float>(distance));
    camera.setAzimuthDegrees(static_cast<float>(options.azimuth_deg));
    camera.setElevationDegrees(static_cast<float>(options.elevation_deg));
}

double focalLength(const ViewOptions& options) {
    return 0.5 * oversampling * options.height_px / std::tan(0.5 * field_of_view_deg * M_PI / 180);
}

/** Lines as rows of dots: drivers draw all lines one pixel wide. \param spacing_m between dots */
CPointCloudColoured::Ptr dotted(const CSetOfLines& lines, double spacing_m) {
    auto dots = CPointCloudColoured::Create();
    const auto color = lines.getColor();
    for (const auto& line : lines) {
        const auto along = line.point2 - line.point1;
        const int count = 1 + static_cast<int>(along.norm() / spacing_m);
        for (int i = 0; i <= count; ++i) {
            const auto p = line.point1 + (static_cast<double>(i) / count) * along;
            dots->push_back(static_cast<float>(p.x), static_cast<float>(p.y),
                            static_cast<float>(p.z), static_cast<float>(color.R),
                            static_cast<float>(color.G), static_cast<float>(color.B));
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
    replace(copy, copy.getViewport()->getByName(scene_names::points), points);
    for (const char* name : {scene_names::graph_before_loops, scene_names::trajectory,
                             scene_names::keyframes, scene_names::loops}) {
        if (const auto lines = objectNamed<CSetOfLines>(copy, name))
            replace(copy, lines, dotted(*lines, pixel_m));
    }
    return copy;
}

cv::Mat rendered(const COpenGLScene& scene, const mrpt::opengl::CCamera& camera,
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
    cv::Mat smooth;
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
    const float highest_m = options.cut_ceiling ? ceilingOf(scene) : INFINITY;
    const bool as_mesh = !mesh.triangles.empty();
    const auto all = objectNamed<CPointCloudColoured>(scene, scene_names::points);
    const auto points = as_mesh ? verticesBelow(mesh, highest_m)
                        : all   ? pointsBelow(*all, highest_m)
                                : CPointCloudColoured::Create();
    mrpt::opengl::CCamera camera;
    aim(camera, frameOf(scene, *points), options);
    const double pixel_m = camera.getZoomDistance() / focalLength(options);
    // So that points of the usual spacing close up to a surface.
    points->setPointSize(
        std::clamp(1.2f * point_spacing_m / static_cast<float>(pixel_m), 2.f, 16.f));
    mrpt::opengl::CRenderizable::Ptr surface = points;
    if (as_mesh) surface = trianglesBelow(mesh, highest_m);
    const cv::Mat picture = rendered(restyled(scene, surface, pixel_m), camera, options);
    writeAtomically(png_path,
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
}

}  // namespace rgbd_graphslam
