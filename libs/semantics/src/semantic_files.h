/** Labeled maps as files. */
#pragma once
#include <map>
#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/point_fusion.h"
#include "rgbd_graphslam/semantics/object_finder.h"

namespace rgbd_graphslam {

/** A keyframe and where in its image an object is seen. */
struct ObjectView {
    double stamp_s = 0;
    int u_min = 0, v_min = 0, u_max = 0, v_max = 0;  // px
};

/** Views of each object, by its index. */
using ObjectViews = std::vector<std::vector<ObjectView>>;

/** The points of a labeled map in the colors of their classes. */
PointMap pointsByClass(const LabelFusion& map, const LabelSet& names);

/** Little-endian PLY: float x y z (m), uchar red green blue of the class, ushort label, float
 *  confidence, ushort views, int object (number in objects.json, -1 = none). */
void saveLabeledPly(const std::string& path, const LabelFusion& map, const LabelSet& names,
                    const FoundObjects& objects, const SemanticOptions& options);

/** The classes and objects as JSON; lengths in m, angles in degrees, pixels of the color images. */
void saveObjects(const std::string& path, const FoundObjects& objects, const LabelSet& names,
                 const ObjectViews& views);

}  // namespace rgbd_graphslam
