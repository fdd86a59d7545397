/** Draws the 3-D view. */
#pragma once
#include <vector>

#include "gl_objects.h"
#include "rgbd_graphslam/viewer/point_chunks.h"
#include "scene_geometry.h"
#include "scene_view.h"

namespace rgbd_graphslam {

/** Two pictures: a fast one while the view moves, with as many points as fit into a frame's time
 *  and, where these would be too few, of half the resolution; and, once it rests, one with all
 *  useful points, drawn slice by slice so that the window stays responsive, and shown when it is
 *  complete. */
class SceneRenderer {
  public:
    /** Everything but the points. */
    SceneGeometry& geometry() { return geometry_; }
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
    struct Picture {
        RenderTarget target;
        int reduction = 1;  // window pixels a pixel
    };
    void begin(Picture& picture, int reduction);
    /** \param density share of the useful points of the finished picture */
    void drawPoints(const Canvas& canvas, double to_share, double density);
    void drawSlice(double to_share, double density, bool is_last);
    void chooseCloud();
    void learnSpeed(double seconds);

    SceneGeometry geometry_;
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
