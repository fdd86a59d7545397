/** Draws the 3-D view. */
#pragma once
#include <array>
#include <chrono>
#include <limits>

#include "gl_objects.h"
#include "rgbd_graphslam/viewer/point_chunks.h"

namespace rgbd_graphslam {

/** What can be shown or hidden by itself. */
enum class Part {
    Floor,
    Grid,
    Octree,
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
    float highest_m = 1e9f;  // of points and octree
    float least_point_px = 2;
    bool points = true;
    /** The clouds of the first so many keyframes instead of the fused points. */
    std::size_t keyframe_clouds = 0;
    std::array<std::size_t, static_cast<std::size_t>(Part::Count)> vertices{};  // 0 = hidden

    std::size_t& of(Part part) { return vertices[static_cast<std::size_t>(part)]; }
    std::size_t of(Part part) const { return vertices[static_cast<std::size_t>(part)]; }
};

/** Two pictures: a fast one while the view moves, with as many points as fit into a frame's time;
 *  and, once it rests, one with all useful points, drawn slice by slice so that the window stays
 *  responsive, and shown when it is complete. */
class SceneRenderer {
  public:
    SceneRenderer();

    void setLines(Part part, const Vertices& lines) { buffer(part).set(lines); }
    void setTriangles(Part part, const Vertices& triangles) { buffer(part).set(triangles); }
    /** \param faces one list a direction, as outerFaces() makes them */
    void setOctree(const std::array<Vertices, 6>& faces);
    void setPoints(ChunkedPoints cloud);
    /** \param points in the world, at most points_a_keyframe */
    void setKeyframePoints(std::size_t keyframe, const Vertices& points);
    void clearKeyframePoints() { keyframe_clouds_.chunks.clear(); }

    /** Starts a new picture and shows its fast form. */
    void draw(const SceneView& view);
    /** Goes on with the complete picture of the last view. \return whether there is more to do */
    bool refine();
    bool complete() const { return drawn_share_ >= 1; }

    void copyToWindow() const { targets_[shown_].copyToWindow(); }
    cv::Mat1f depthsAround(const Eigen::Vector2i& pixel, int radius_px) const {
        return targets_[shown_].depthsAround(pixel, radius_px);
    }
    std::size_t pointsDrawn() const { return points_drawn_; }
    std::size_t points() const { return map_.buffer.size(); }

  private:
    struct Cloud {
        VertexBuffer buffer;
        std::vector<PointChunk> chunks;
        float spacing_m;
    };
    VertexBuffer& buffer(Part part) { return parts_[static_cast<std::size_t>(part)]; }
    void clear();
    void drawSolids();
    void drawOctree();
    void drawLines();
    /** \param density share of the useful points of the finished picture */
    void drawPoints(double from_share, double to_share, double density);
    void prepareSurfaceShader(float spacing_m, double density);
    void drawSlice(double to_share, double density);
    void chooseCloud();
    void learnSpeed(double seconds);

    ShaderProgram surface_, line_;
    std::array<VertexBuffer, static_cast<std::size_t>(Part::Count)> parts_;
    std::array<std::size_t, 7> octree_starts_{};
    Cloud map_{{}, {}, 0.01f}, keyframe_clouds_{{}, {}, 0.03f};

    SceneView view_;
    const Cloud* cloud_ = nullptr;  // the one that is shown
    std::vector<std::size_t> useful_;
    std::size_t useful_total_ = 0, points_drawn_ = 0;
    double drawn_share_ = 1;
    /** Points that can be drawn in the time of a frame, as measured. */
    double points_a_frame_ = 300000;
    std::array<RenderTarget, 2> targets_;
    int shown_ = 0;
};

}  // namespace rgbd_graphslam
