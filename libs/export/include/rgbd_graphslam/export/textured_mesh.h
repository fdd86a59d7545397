/** A mesh with a picture on it. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/export/atlas_packing.h"
#include "rgbd_graphslam/export/view_selection.h"
#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** Triangles with texture coordinates, and the texture. */
struct TexturedMesh {
    std::vector<Eigen::Vector3f> vertices;  // m
    /** One per vertex, in [0, 1]; (0, 0) is the upper left corner of the texture. */
    std::vector<Eigen::Vector2f> uv;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    cv::Mat3b texture;  // BGR
};

/** Makes a texture for a mesh from images that are given one by one, twice: first all go to
 *  addView(), then, after plan(), all go to paint(). Triangles that hang together and get the same
 *  image are a chart, a rectangle of that image in the texture (the outline follows Waechter et
 * al., "Let there be color!", ECCV 2014). Slow changes of color over a chart are replaced by those
 * of the mesh's own colors, the mean of all views, so that exposure changes do not show as seams.
 * Triangles that no image shows get the mean color of their vertices. */
class TextureBuilder {
  public:
    /** \param mesh with colors; must outlive this
     *  \param most_px largest width and height of the texture */
    TextureBuilder(const PlyModel& mesh, int most_px);

    /** \param camera without distortion; \param depth as ViewSelection::add() */
    void addView(int view, const Camera& camera, const SE3& T_world_cam, const cv::Mat1w& depth,
                 double depth_unit_m);

    /** Decides on charts and their places. \throws Error when the texture gets too large */
    void plan();

    /** \param color of the view as addView() got it */
    void paint(int view, const Camera& camera, const SE3& T_world_cam, const cv::Mat3b& color);

    /** To be called once, after all are painted. */
    TexturedMesh take() { return std::move(result_); }

    /** Share of the mesh's triangles that some image shows. */
    double coveredShare() const;

  private:
    struct View {
        int number;
        Camera camera;
        SE3 T_world_cam;
    };
    struct Chart {
        int view = ViewSelection::no_view;
        cv::Rect in_image;
        std::vector<std::uint32_t> triangles;
        /** Range of its vertices in the result. */
        std::size_t first_vertex = 0, last_vertex = 0;
    };

    void collectCharts();
    Chart chartFrom(std::uint32_t seed, const TriangleNeighbors& neighbors,
                    std::vector<bool>& taken) const;
    void measureCharts();
    void collectSwatches();
    void placeCharts();
    void placeChart(const Chart& chart, const cv::Point& corner);
    void placeSwatches();
    /** \param pixel of the texture */
    void addVertex(std::uint32_t vertex, const Eigen::Vector2f& pixel);
    /** What to add to the image within a chart, so that it has on average, over some 15 pixels
     *  around, the color that all views together gave to the mesh: normalized convolution (Knutsson
     *  and Westin, CVPR 1993) of the differences at the chart's vertices. */
    cv::Mat3f correctionOf(const Chart& chart, const cv::Mat3b& color, const View& view) const;
    const View& viewOf(int number) const;

    const PlyModel& mesh_;
    int most_px_;
    ViewSelection selection_;
    std::vector<View> views_;  // by rising number
    std::vector<int> view_of_triangle_;
    std::vector<Chart> charts_;
    /** Colors of triangles without a view, rounded, and which of them each such triangle has. */
    std::vector<cv::Vec3b> swatches_;
    std::vector<std::pair<std::uint32_t, std::size_t>> swatch_of_triangle_;
    AtlasLayout layout_;                 // of charts, then swatches
    std::vector<std::uint32_t> source_;  // of each vertex of the result
    TexturedMesh result_;
};

}  // namespace rgbd_graphslam
