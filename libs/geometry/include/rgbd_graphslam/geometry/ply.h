/** Point clouds and triangle meshes in PLY files. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** In meters; without triangles a cloud of points. */
struct PlyModel {
    std::vector<Eigen::Vector3f> vertices;
    /** Of unit length; as many as vertices, or none. */
    std::vector<Eigen::Vector3f> normals;
    /** Red, green, blue; as many as vertices, or none. */
    std::vector<std::array<std::uint8_t, 3>> colors;
    /** Indices of vertices. */
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/** Reads ASCII and little-endian binary files; faces of more than three corners become fans, what
 *  is neither place, normal, color nor face is skipped.
 *  \throws Error naming the file for another format, a file that is cut off, a place that is not
 *          finite, an index without vertex, or no vertex at all */
PlyModel readPly(const std::string& path);

/** Writes a little-endian binary file, whole or not at all. */
void writePly(const std::string& path, const PlyModel& model);

}  // namespace rgbd_graphslam
