/** What of a scene is shown, and from where. */
#pragma once
#include <array>
#include <limits>

#include "rgbd_graphslam/mapping/orbit_camera.h"

namespace rgbd_graphslam {

/** What can be shown or hidden by itself. */
enum class Part {
    Floor,
    Grid,
    Mesh,
    Octree,
    FreeSpace,
    Path,
    TruePath,
    Errors,
    Keyframes,
    Covisibility,
    Loops,
    BeforeLoops,
    NowCamera,
    Selection,
    Measure,
    Count
};

constexpr std::size_t whole = std::numeric_limits<std::size_t>::max();

/** How the scene is to be shown. Lists are drawn up to a count, so that a replay shows a prefix. */
struct SceneView {
    OrbitCamera camera;
    Eigen::Vector2i size_px{1, 1};
    bool color_by_height = false;
    Eigen::Vector2f height_range_m{0, 2.5f};
    float highest_m = 1e9f;  // of points, mesh and octree
    float least_point_px = 2;
    bool points = true;
    /** In which a picture of a moving view is to be drawn. */
    double time_s = 0.04;
    /** The clouds of the first so many keyframes instead of the fused points. */
    std::size_t keyframe_clouds = 0;
    std::array<std::size_t, static_cast<std::size_t>(Part::Count)> vertices{};  // 0 = hidden

    std::size_t& of(Part part) { return vertices[static_cast<std::size_t>(part)]; }
    std::size_t of(Part part) const { return vertices[static_cast<std::size_t>(part)]; }
};

}  // namespace rgbd_graphslam
