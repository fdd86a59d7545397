/** Files of what the viewer shows. */
#pragma once
#include <filesystem>
#include <string>

#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** The kinds of files. */
enum class ExportFormat { Ply, Pcd, Mesh, ColorOctree, BinaryOctree };

/** The ending of its files' names, with the dot. */
const char* extensionOf(ExportFormat format);

/** The first of STEM-1.EXTENSION, STEM-2.EXTENSION, … that does not exist.
 *  \param folder empty stands for the current one */
std::string freeName(const std::filesystem::path& folder, const std::string& stem,
                     const std::string& extension);

/** \param points world, m
 *  \param format Ply or Pcd
 *  \throws Error when there is no point, or the file cannot be written */
void exportPoints(const Vertices& points, ExportFormat format, const std::string& path);

/** The mesh of a run without the triangles that reach higher than `highest_m`.
 *  \param folder of the run
 *  \param path of a `.ply`
 *  \throws Error when the run has none, nothing of it is left, or the file cannot be written */
void exportMesh(const std::string& folder, double highest_m, const std::string& path);

/** The octree of a run without the leaves whose centers are higher than `highest_m`.
 *  \param folder of the run
 *  \param format ColorOctree or BinaryOctree
 *  \throws Error when the run has none, or the file cannot be written */
void exportOctree(const std::string& folder, double highest_m, ExportFormat format,
                  const std::string& path);

}  // namespace rgbd_graphslam
