/** Which image shows each triangle of a mesh best. */
#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** Index of the triangle beyond each edge (0-1, 1-2, 2-0), or -1: at a border, and where more than
 *  two triangles share an edge. */
using TriangleNeighbors = std::vector<std::array<std::int32_t, 3>>;
TriangleNeighbors neighborsOf(const std::vector<std::array<std::uint32_t, 3>>& triangles);

/** What a camera without distortion sees of a mesh. */
struct ProjectedMesh {
    ProjectedMesh(const PlyModel& mesh, const Camera& camera, const SE3& T_world_cam);

    /** Pixel and depth (m) of each vertex; depth is not positive behind the camera. */
    std::vector<Eigen::Vector3f> vertices;
    /** Depth of the nearest triangle, m; infinite where there is none. */
    cv::Mat1f nearest;
};

/** Collects views one by one and keeps the best few of each triangle. A view shows a triangle when
 *  it lies in the image as a whole, is not hidden by the mesh and agrees with the depth image, so
 * that people who walked by do not end up on walls. The larger its projection and the more it faces
 * the camera the better. Noise turns some triangles away from all cameras that saw them: views of a
 * back come last. */
class ViewSelection {
  public:
    static constexpr int no_view = -1;

    /** \param mesh must outlive this */
    explicit ViewSelection(const PlyModel& mesh);

    /** \param depth in units of depth_unit_m, 0 = none, of the camera's size
     *  \param view its number */
    void add(int view, const Camera& camera, const SE3& T_world_cam, const cv::Mat1w& depth,
             double depth_unit_m);

    /** The view of each triangle, or no_view. Neighbors are given the same view where that costs
     *  little sharpness: a Potts model, improved triangle by triangle (iterated conditional modes;
     *  Besag, "On the statistical analysis of dirty pictures", 1986).
     *  \param neighbors of the mesh */
    std::vector<int> views(const TriangleNeighbors& neighbors) const;

  private:
    static constexpr std::size_t candidates = 6;
    struct Candidate {
        int view = no_view;
        float score = 0;
    };

    float score(std::size_t triangle, const ProjectedMesh& seen, const Camera& camera,
                const cv::Mat1w& depth, double depth_unit_m) const;
    void keep(std::size_t triangle, Candidate candidate);
    int cheapest(std::size_t triangle, const std::array<std::int32_t, 3>& neighbors,
                 const std::vector<int>& views) const;

    const PlyModel& mesh_;
    float tolerance_m_;
    std::vector<std::array<Candidate, candidates>> best_;  // best first
};

}  // namespace rgbd_graphslam
