/** What a scene consists of, in graphics memory. */
#pragma once
#include <array>
#include <vector>

#include "gl_objects.h"
#include "rgbd_graphslam/viewer/point_chunks.h"
#include "scene_view.h"

namespace rgbd_graphslam {

/** The picture that is bound and drawn to. */
struct Canvas {
    const SceneView& view;
    Eigen::Vector2i size_px;
    int reduction = 1;  // window pixels a pixel
    bool moving = false;
};

/** Lines, triangles and cells, and how all that is in a scene is drawn. */
class SceneGeometry {
  public:
    SceneGeometry();

    void setLines(Part part, const Vertices& lines) { buffer(part).set(lines); }
    /** Takes the place of what is there from vertex `first` on. */
    void extendLines(Part part, std::size_t first, const Vertices& lines) {
        buffer(part).write(first, lines);
    }
    void setTriangles(Part part, const Vertices& triangles) { buffer(part).set(triangles); }
    /** \param fewer for pictures of a moving view */
    void setMesh(const Vertices& vertices, const Triangles& triangles, const Triangles& fewer);
    /** Occupied and free cells. \param faces one list a direction, as outerFaces() makes them */
    void setOctree(const std::array<Vertices, 6>& faces) { occupied_.set(faces); }
    void setFreeSpace(const std::array<Vertices, 6>& faces) { free_.set(faces); }

    /** An empty picture with mesh, occupied cells, grid and lines. */
    void drawFirst(const Canvas& canvas);
    /** \param spacing_m between points, all of them
     *  \param density share of them that the finished picture has; fewer are drawn larger */
    void drawPoints(const Canvas& canvas, const VertexBuffer& points,
                    const std::vector<DrawRange>& ranges, float spacing_m, double density);
    /** Free cells, like glass over all that is not transparent, and marks over all. */
    void drawLast(const Canvas& canvas);

  private:
    /** Sides of cells, sorted by direction, since each direction has its brightness. */
    struct Faces {
        VertexBuffer buffer;
        std::array<std::size_t, 7> starts{};
        void set(const std::array<Vertices, 6>& faces);
    };
    VertexBuffer& buffer(Part part) { return parts_[static_cast<std::size_t>(part)]; }
    void prepareSurfaceShader(const Canvas& canvas);
    void drawSolids(const Canvas& canvas);
    void drawFaces(const Faces& faces);
    void drawFreeSpace(const Canvas& canvas);
    void drawLines(const Canvas& canvas, Part part, float width_px);

    ShaderProgram surface_, line_;
    std::array<VertexBuffer, static_cast<std::size_t>(Part::Count)> parts_;
    IndexBuffer mesh_triangles_, fewer_triangles_;
    Faces occupied_, free_;
};

}  // namespace rgbd_graphslam
