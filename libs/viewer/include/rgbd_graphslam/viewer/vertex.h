/** What the viewer's graphics memory is filled with. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/mapping/scene_colors.h"

namespace rgbd_graphslam {

/** A corner of a point, line or triangle; 16 bytes, uploaded as it lies in memory. */
struct Vertex {
    Eigen::Vector3f position;  // world, m
    Rgba color;
};
static_assert(sizeof(Vertex) == 16);

using Vertices = std::vector<Vertex>;

/** Indices of vertices. */
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

}  // namespace rgbd_graphslam
