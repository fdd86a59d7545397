#include "rgbd_graphslam/semantics/semantic_options.h"

namespace rgbd_graphslam {

void SemanticOptions::describe(OptionVisitor& v) {
    v.choice("moving_classes", moving_classes, {},
             "Classes that tracking and maps leave out, separated by spaces: person dog car");
    v.real("label_voxel_m", label_voxel_m, 0.005, 1, "m",
           "Voxel that has one distribution of labels");
    v.real("frame_accuracy", frame_accuracy, 0.5, 0.999, "",
           "Share of pixels that a label image gets right");
    v.real("min_confidence", min_confidence, 0, 1, "",
           "Voxels whose best label is less probable belong to no object");
    v.choice("stuff_classes", stuff_classes, {},
             "Classes that form no objects, separated by spaces");
    v.real("object_gap_m", object_gap_m, 0, 1, "m",
           "Surfaces of one class with a wider gap between them are two objects");
    v.real("min_object_m", min_object_m, 0.01, 10, "m", "Longest side of the smallest object");
}

}  // namespace rgbd_graphslam
