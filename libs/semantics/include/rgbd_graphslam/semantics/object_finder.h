/** Things in a labeled map. */
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "rgbd_graphslam/dataset/label_set.h"
#include "rgbd_graphslam/semantics/label_fusion.h"
#include "rgbd_graphslam/semantics/semantic_options.h"

namespace rgbd_graphslam {

/** A box that stands upright, turned about the vertical. */
struct UprightBox {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // m, in the map
    Eigen::Vector3d size = Eigen::Vector3d::Zero();    // m; the longer horizontal side first
    double yaw_rad = 0;  // of the longer horizontal side, from +x; -pi/2 to pi/2
};

/** A connected surface of one class. */
struct MapObject {
    int label = 0;
    double confidence = 0;  // mean probability of the class over its voxels
    UprightBox box;
    std::size_t voxels = 0;
};

/** Objects, and which of them each voxel belongs to. */
struct FoundObjects {
    std::vector<MapObject> objects;                          // largest first
    std::unordered_map<std::uint64_t, int> object_of_voxel;  // index into objects, by voxel key
};

/** Surfaces of one class that no gap divides; classes without a shape of their own ("stuff": walls,
 *  floors) form no objects. \param names of the classes in the map */
FoundObjects findObjects(const LabelFusion& map, const LabelSet& names,
                         const SemanticOptions& options);

/** The box around points with the smallest floor area, without the outermost 1 % to each side.
 *  \param points m, z up; at least one */
UprightBox boxAround(const std::vector<Eigen::Vector3f>& points);

}  // namespace rgbd_graphslam
