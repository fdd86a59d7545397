/** Octrees as OctoMap and its users know them. */
#pragma once
#include <memory>

#include "rgbd_graphslam/mapping/occupancy_volume.h"

namespace octomap {
class OcTree;
class ColorOcTree;
}  // namespace octomap

namespace rgbd_graphslam {

/** Which log-odds the leaves get. */
enum class LeafValues {
    Exact,
    /** OctoMap's limits, whichever is likelier: prunes to far fewer nodes; all a `.bt` can hold. */
    MaximumLikelihood
};

/** Pruned, inner nodes up to date. Space never seen has no node. */
std::unique_ptr<octomap::OcTree> toOcTree(const OccupancyVolume& volume, LeafValues values);

/** As toOcTree with exact values, and with the mean color of what was seen in each occupied leaf.
 *  Occupied leaves are never merged, so that each keeps its color. */
std::unique_ptr<octomap::ColorOcTree> toColorOcTree(const OccupancyVolume& volume);

}  // namespace rgbd_graphslam
