#include "rgbd_graphslam/mapping/map_scene.h"

#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/stock_objects.h>

#include "rgbd_graphslam/mapping/framing.h"
#include "rgbd_graphslam/mapping/scene_colors.h"
#include "rgbd_graphslam/mapping/view_scale.h"

namespace rgbd_graphslam {
namespace {

using mrpt::img::TColor;

TColor colorOf(const Rgba& color) {
    return {color[0], color[1], color[2], color[3]};
}

mrpt::math::TPoint3D point(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

mrpt::opengl::CSetOfLines::Ptr lines(const char* name, const Rgba& color, float width_px) {
    auto object = mrpt::opengl::CSetOfLines::Create();
    object->setName(name);
    object->setColor_u8(colorOf(color));
    object->setLineWidth(width_px);
    return object;
}

void addSegment(mrpt::opengl::CSetOfLines& object, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b) {
    object.appendLine(mrpt::math::TSegment3D(point(a), point(b)));
}

/** \param unplaced_s where it is not drawn, as in MapInputs */
void addPath(mrpt::opengl::CSetOfLines& object, const Trajectory& poses,
             const std::vector<double>& unplaced_s) {
    for (std::size_t i = 1; i < poses.size(); ++i) {
        if (anyBetween(unplaced_s, poses[i - 1].stamp_s, poses[i].stamp_s)) continue;
        addSegment(object, poses[i - 1].T_world_cam.t, poses[i].T_world_cam.t);
    }
}

mrpt::opengl::CSetOfLines::Ptr trajectoryLines(const MapInputs& inputs) {
    auto object = lines(scene_names::trajectory, trajectory_color, 3);
    addPath(*object, inputs.trajectory, inputs.unplaced_s);
    return object;
}

mrpt::opengl::CSetOfLines::Ptr linesBeforeLoops(const MapInputs& inputs) {
    auto object = lines(scene_names::graph_before_loops, before_color, 2);
    const auto sessions = pieces(inputs.keyframes_before_loops, sessionLengths(inputs));
    for (const Trajectory& session : sessions) {
        const bool is_latest = &session == &sessions.back();  // unplaced frames are of that one
        addPath(*object, session, is_latest ? inputs.unplaced_s : std::vector<double>());
    }
    return object;
}

void addFrustum(mrpt::opengl::CSetOfLines& object, const SE3& T, const Camera& camera,
                double depth_m) {
    const double w = camera.width - 1, h = camera.height - 1;
    const auto corner = [&](double u, double v) { return T * camera.unproject(u, v, depth_m); };
    const Eigen::Vector3d corners[] = {corner(0, 0), corner(w, 0), corner(w, h), corner(0, h)};
    for (int i = 0; i < 4; ++i) {
        addSegment(object, T.t, corners[i]);
        addSegment(object, corners[i], corners[(i + 1) % 4]);
    }
}

mrpt::opengl::CSetOfLines::Ptr frustums(const Trajectory& keyframes, const Camera& camera) {
    auto object = lines(scene_names::keyframes, keyframe_color, 1.5f);
    const double depth_m = frustumDepth(keyframes);
    for (const std::size_t k : sparseKeyframes(keyframes, depth_m))
        addFrustum(*object, keyframes[k].T_world_cam, camera, depth_m);
    return object;
}

mrpt::opengl::CSetOfLines::Ptr loopLines(const MapInputs& inputs) {
    auto object = lines(scene_names::loops, loop_color, 3);
    for (const MapLoopEdge& loop : inputs.loops) {
        addSegment(*object, inputs.keyframes[loop.from].T_world_cam.t,
                   inputs.keyframes[loop.to].T_world_cam.t);
    }
    return object;
}

/** At the middle of each loop the number of matches that agree with it. */
mrpt::opengl::CSetOfObjects::Ptr loopInliers(const MapInputs& inputs) {
    auto all = mrpt::opengl::CSetOfObjects::Create();
    all->setName(scene_names::loop_inliers);
    for (const MapLoopEdge& loop : inputs.loops) {
        const Eigen::Vector3d &from = inputs.keyframes[loop.from].T_world_cam.t,
                              &to = inputs.keyframes[loop.to].T_world_cam.t;
        auto text = mrpt::opengl::CText::Create(std::to_string(loop.inliers));
        text->setName("loop " + std::to_string(loop.from) + "-" + std::to_string(loop.to));
        text->setColor_u8(colorOf(loop_color));
        text->setLocation(point((from + to) / 2));
        all->insert(text);
    }
    return all;
}

mrpt::opengl::CPointCloudColoured::Ptr cloud(const PointMap& points) {
    auto object = mrpt::opengl::CPointCloudColoured::Create();
    object->setName(scene_names::points);
    object->setPointSize(2);
    object->reserve(points.size());
    for (const auto& [p, rgb] : points) {
        object->push_back(p.x(), p.y(), p.z(), rgb[0] / 255.f, rgb[1] / 255.f, rgb[2] / 255.f);
    }
    return object;
}

mrpt::opengl::CGridPlaneXY::Ptr floorLines(const MapInputs& inputs, const PointMap& points) {
    const FloorGrid grid = floorGrid(framingOf(points, inputs.keyframes, inputs.trajectory).box);
    const auto f = [](double m) { return static_cast<float>(m); };
    auto object = mrpt::opengl::CGridPlaneXY::Create(
        f(grid.x_min_m), f(grid.x_max_m), f(grid.y_min_m), f(grid.y_max_m), 0.f, f(grid.step_m));
    object->setName(scene_names::floor);
    object->setColor_u8(colorOf(floor_color));
    return object;
}

}  // namespace

mrpt::opengl::COpenGLScene makeScene(const MapInputs& inputs, const PointMap& points,
                                     const Camera& camera) {
    mrpt::opengl::COpenGLScene scene;
    scene.getViewport()->setCustomBackgroundColor(mrpt::img::TColorf(colorOf(background_color)));
    scene.insert(floorLines(inputs, points));
    scene.insert(cloud(points));
    scene.insert(trajectoryLines(inputs));
    scene.insert(frustums(inputs.keyframes, camera));
    scene.insert(loopLines(inputs));
    scene.insert(loopInliers(inputs));
    scene.insert(linesBeforeLoops(inputs));
    return scene;
}

}  // namespace rgbd_graphslam
