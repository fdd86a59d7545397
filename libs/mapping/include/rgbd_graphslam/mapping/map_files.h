/** Maps as files; each is written under a temporary name, checked and renamed. All functions throw
 *  Error naming the file when it cannot be written whole. */
#pragma once
#include <memory>
#include <string>

#include "rgbd_graphslam/mapping/point_fusion.h"

namespace mrpt::serialization {
class CSerializable;
}
namespace mrpt::maps {
class COccupancyGridMap2D;
}
namespace octomap {
class OcTree;
class ColorOcTree;
}  // namespace octomap

namespace rgbd_graphslam {

/** Binary little-endian PLY: float x y z (m), uchar red green blue. */
void savePly(const std::string& path, const PointMap& points);

/** Binary PCD 0.7 with fields x y z rgb, as PCL's PointXYZRGB. */
void savePcd(const std::string& path, const PointMap& points);

/** MRPT CSimplePointsMap, the class that mrpt_map_server takes; without color. */
void saveMetricMap(const std::string& path, const PointMap& points);

/** Any object of MRPT in its gzip-compressed form: `.gridmap.gz`, `.simplemap`, `.3Dscene`. */
void saveMrptObject(const std::string& path, const mrpt::serialization::CSerializable& object);

/** OctoMap's `.bt`: occupied, free or unknown. */
void saveBinaryOcTree(const std::string& path, const octomap::OcTree& tree);

/** OctoMap's `.ot`: log-odds and color. */
void saveColorOcTree(const std::string& path, const octomap::ColorOcTree& tree);

/** Reads a `.bt`. The file is proven whole before OctoMap, which would trust it, sees it.
 *  \throws Error when the file is missing, another format, cut off or damaged */
std::unique_ptr<octomap::OcTree> loadBinaryOcTree(const std::string& path);

/** Reads a colored `.ot`. \throws Error as loadBinaryOcTree does */
std::unique_ptr<octomap::ColorOcTree> loadColorOcTree(const std::string& path);

/** Reads the colored points of a PLY, as readPly does.
 *  \throws Error as readPly does, or when there are no colors */
PointMap loadPly(const std::string& path);

/** Reads a `.gridmap.gz`. \throws Error when the file is missing, cut off or no grid map */
mrpt::maps::COccupancyGridMap2D loadGridMap(const std::string& path);

/** ROS's map_server pair: an 8-bit PNG (occupied 0, free 254, unknown 205) and the YAML that says
 *  where it lies. \param stem path without extension */
void saveRosGrid(const std::string& stem, const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace rgbd_graphslam
