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
    float highest_m = 1e9f;  // of points and octree
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

/** Two pictures: a fast one while the view moves, with as many points as fit into a frame's time
 *  and, where these would be too few, of half the resolution; and, once it rests, one with all
 *  useful points, drawn slice by slice so that the window stays responsive, and shown when it is
 *  complete. */
class SceneRenderer {
  public:
    SceneRenderer();

    void setLines(Part part, const Vertices& lines) { buffer(part).set(lines); }
    /** Takes the place of what is there from vertex `first` on. */
    void extendLines(Part part, std::size_t first, const Vertices& lines) {
        buffer(part).write(first, lines);
    }
    void setTriangles(Part part, const Vertices& triangles) { buffer(part).set(triangles); }
    /** Occupied and free cells. \param faces one list a direction, as outerFaces() makes them */
    void setOctree(const std::array<Vertices, 6>& faces) { occupied_.set(faces); }
    void setFreeSpace(const std::array<Vertices, 6>& faces) { free_.set(faces); }
    void setPoints(ChunkedPoints cloud);
    /** \param points in the world, at most points_a_keyframe */
    void setKeyframePoints(std::size_t keyframe, const Vertices& points);
    void clearKeyframePoints() { keyframe_clouds_.chunks.clear(); }

    /** Starts a new picture and shows its fast form. */
    void draw(const SceneView& view);
    /** Goes on with the complete picture of the last view. \return whether there is more to do */
    bool refine();
    bool complete() const { return drawn_share_ >= 1; }

    void copyToWindow() const;
    /** As RenderTarget has them, at the window's pixels. */
    cv::Mat1f depthsAround(const Eigen::Vector2i& pixel, int radius_px) const;
    std::size_t pointsDrawn() const { return points_drawn_; }
    std::size_t points() const { return map_.buffer.size(); }
    /** All points that the last view could show, those above its cut left out. */
    Vertices shownPoints() const;

  private:
    struct Cloud {
        VertexBuffer buffer;
        std::vector<PointChunk> chunks;
        float spacing_m;
    };
    /** Sides of cells, sorted by direction, since each direction has its brightness. */
    struct Faces {
        VertexBuffer buffer;
        std::array<std::size_t, 7> starts{};
        void set(const std::array<Vertices, 6>& faces);
    };
    struct Picture {
        RenderTarget target;
        int reduction = 1;  // window pixels a pixel
    };
    void begin(Picture& picture, int reduction);
    VertexBuffer& buffer(Part part) { return parts_[static_cast<std::size_t>(part)]; }
    void clear();
    void drawSolids();
    void drawFaces(const Faces& faces);
    void drawFreeSpace();
    void drawLines();
    /** \param density share of the useful points of the finished picture */
    void drawPoints(double from_share, double to_share, double density);
    void prepareSurfaceShader(float spacing_m, double density);
    void drawSlice(double to_share, double density, bool is_last);
    void chooseCloud();
    void learnSpeed(double seconds);

    ShaderProgram surface_, line_;
    std::array<VertexBuffer, static_cast<std::size_t>(Part::Count)> parts_;
    Faces occupied_, free_;
    Cloud map_{{}, {}, 0.01f}, keyframe_clouds_{{}, {}, 0.03f};

    SceneView view_;
    const Cloud* cloud_ = nullptr;  // the one that is shown
    std::vector<std::size_t> useful_;
    std::size_t useful_total_ = 0, points_drawn_ = 0;
    double drawn_share_ = 1;
    /** Points that can be drawn in the time of a frame, as measured. */
    double points_a_frame_ = 300000;
    bool coarse_ = false;  // whether moving pictures are of half the resolution
    Picture moving_, resting_;
    const Picture *drawn_ = &moving_, *shown_ = &moving_;
    Eigen::Vector2i size_px_{1, 1};  // of the picture that is drawn
};

}  // namespace rgbd_graphslam
