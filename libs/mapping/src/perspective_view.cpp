#include "rgbd_graphslam/mapping/perspective_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/mapping/framing.h"
#include "rgbd_graphslam/mapping/orbit_camera.h"
#include "rgbd_graphslam/mapping/picture_marks.h"

namespace rgbd_graphslam {
namespace {

constexpr double elevation_rad = 0.87, turned_rad = 0.3;  // obliquely, so that corners are seen
constexpr std::size_t most_points = 3000000;
constexpr int largest_radius_px = 8;

OrbitCamera cameraFor(const Framing& framing, const Eigen::Vector2i& size_px) {
    OrbitCamera camera;
    if (framing.box.isEmpty()) return camera;
    const bool is_wide = framing.box.sizes().x() >= framing.box.sizes().y();
    camera.azimuth_rad = (is_wide ? -M_PI / 2 : M_PI) - turned_rad;
    camera.elevation_rad = elevation_rad;
    camera.frame(framing.points, size_px);
    return camera;
}

class PerspectiveSheet {
  public:
    PerspectiveSheet(const OrbitCamera& camera, const cv::Size& size_px)
        : picture_(size_px,
                   cv::Vec3b(background_color[2], background_color[1], background_color[0])),
          nearness_(size_px, 0.f),
          camera_(camera),
          size_px_(size_px.width, size_px.height) {}

    /** Squares that close up to surfaces; the nearest one wins a pixel. */
    void addPoints(const PointMap& points, double spacing_m, double highest_m) {
        const std::size_t step = points.size() / most_points + 1;
        const Eigen::Matrix4f clip = camera_.clipFromWorld(size_px_).cast<float>();
        const double reach_m = 0.6 * spacing_m * std::sqrt(static_cast<double>(step));
        const auto reach_px = static_cast<float>(reach_m * OrbitCamera::focalPx(size_px_.y()));
        for (std::size_t i = 0; i < points.size(); i += step) {
            if (points[i].position.z() <= static_cast<float>(highest_m))
                addPoint(clip * points[i].position.homogeneous(), points[i].rgb, reach_px);
        }
    }

    void addLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Rgba& color, int width) {
        const Eigen::Vector3d p = camera_.project(a, size_px_), q = camera_.project(b, size_px_);
        if (p.z() <= 0 || q.z() <= 0 || !isNear(p) || !isNear(q)) return;
        const auto at = [](const Eigen::Vector3d& uvz) {
            return cv::Point(static_cast<int>(std::lround(uvz.x())),
                             static_cast<int>(std::lround(uvz.y())));
        };
        cv::line(picture_, at(p), at(q), bgrOf(color), width, cv::LINE_AA);
    }

    void addPath(const Trajectory& poses, const std::vector<double>& unplaced_s) {
        for (std::size_t i = 1; i < poses.size(); ++i) {
            if (!anyBetween(unplaced_s, poses[i - 1].stamp_s, poses[i].stamp_s))
                addLine(poses[i - 1].T_world_cam.t, poses[i].T_world_cam.t, trajectory_color, 2);
        }
    }

    void addFloor(const FloorGrid& grid) {
        const auto lines = [](double low, double high, double step, const auto& draw) {
            for (double m = low; m <= high + 1e-6; m += step) draw(m);
        };
        lines(grid.x_min_m, grid.x_max_m, grid.step_m, [&](double x) {
            addLine({x, grid.y_min_m, 0}, {x, grid.y_max_m, 0}, floor_color, 1);
        });
        lines(grid.y_min_m, grid.y_max_m, grid.step_m, [&](double y) {
            addLine({grid.x_min_m, y, 0}, {grid.x_max_m, y, 0}, floor_color, 1);
        });
    }

    /** A pyramid of lines that opens to where the camera looks. */
    void addKeyframe(const SE3& T, double depth_m) {
        const double x = 0.6 * depth_m, y = 0.45 * depth_m;
        const Eigen::Vector3d corners[] = {
            T * Eigen::Vector3d(-x, -y, depth_m), T * Eigen::Vector3d(x, -y, depth_m),
            T * Eigen::Vector3d(x, y, depth_m), T * Eigen::Vector3d(-x, y, depth_m)};
        for (int i = 0; i < 4; ++i) {
            addLine(T.t, corners[i], keyframe_color, 1);
            addLine(corners[i], corners[(i + 1) % 4], keyframe_color, 1);
        }
    }

    cv::Mat3b finished(const FloorGrid& grid) {
        drawLabels(picture_, floorLabels(grid, camera_, size_px_));
        drawScaleBar(picture_, camera_.distance_m / OrbitCamera::focalPx(size_px_.y()));
        return picture_;
    }

  private:
    /** OpenCV draws lines that begin far outside slowly or wrongly. */
    bool isNear(const Eigen::Vector3d& uvz) const {
        return std::abs(uvz.x()) < 10. * size_px_.x() && std::abs(uvz.y()) < 10. * size_px_.y();
    }

    void addPoint(const Eigen::Vector4f& clip, const std::array<std::uint8_t, 3>& rgb,
                  float reach_px) {
        const float w = clip.w();
        if (!(w > 0)) return;
        const float u = 0.5f * static_cast<float>(size_px_.x()) * (1 + clip.x() / w);
        const float v = 0.5f * static_cast<float>(size_px_.y()) * (1 - clip.y() / w);
        const float radius = std::min(reach_px / w, static_cast<float>(largest_radius_px));
        if (!(u > -radius && v > -radius && u < static_cast<float>(size_px_.x()) + radius &&
              v < static_cast<float>(size_px_.y()) + radius))
            return;
        const auto first = [&](float x) {
            return std::max(0, static_cast<int>(std::lround(x - radius)));
        };
        const auto end = [&](float x, int from, int size) {
            return std::min(size, std::max(from + 1, static_cast<int>(std::lround(x + radius))));
        };
        const int u0 = first(u), v0 = first(v);
        const int u1 = end(u, u0, size_px_.x()), v1 = end(v, v0, size_px_.y());
        const float nearness = 1 / w;
        for (int y = v0; y < v1; ++y) {
            for (int x = u0; x < u1; ++x) {
                if (nearness <= nearness_(y, x)) continue;
                nearness_(y, x) = nearness;
                picture_(y, x) = {rgb[2], rgb[1], rgb[0]};
            }
        }
    }

    cv::Mat3b picture_;
    cv::Mat1f nearness_;  // 1/m of what a pixel shows
    OrbitCamera camera_;
    Eigen::Vector2i size_px_;
};

}  // namespace

cv::Mat3b perspectiveView(const MapInputs& inputs, const PointMap& points, double spacing_m,
                          const cv::Size& size_px) {
    const double highest_m = pictureCeiling(inputs);
    const Framing framing = framingOf(points, inputs.keyframes, inputs.trajectory, highest_m);
    PerspectiveSheet sheet(cameraFor(framing, {size_px.width, size_px.height}), size_px);
    const FloorGrid grid = floorGrid(framing.box);
    sheet.addFloor(grid);
    sheet.addPoints(points, spacing_m, highest_m);
    sheet.addPath(inputs.trajectory, inputs.unplaced_s);
    const double depth_m = frustumDepth(inputs.keyframes);
    for (const std::size_t k : sparseKeyframes(inputs.keyframes, depth_m))
        sheet.addKeyframe(inputs.keyframes[k].T_world_cam, depth_m);
    for (const MapLoopEdge& loop : inputs.loops) {
        sheet.addLine(inputs.keyframes[static_cast<std::size_t>(loop.from)].T_world_cam.t,
                      inputs.keyframes[static_cast<std::size_t>(loop.to)].T_world_cam.t, loop_color,
                      2);
    }
    return sheet.finished(grid);
}

}  // namespace rgbd_graphslam
