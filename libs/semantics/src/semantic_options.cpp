#include "rgbd_graphslam/semantics/semantic_options.h"

namespace rgbd_graphslam {

void SemanticOptions::describe(OptionVisitor& v) {
    v.choice("moving_classes", moving_classes, {},
             "Classes that tracking and maps leave out, separated by spaces: person dog car");
    v.choice("model", model, {},
             "ONNX model that labels keyframes instead of the recording's label images");
    v.choice("model_labels", model_labels, {}, "File with the names of its classes, as labels.ini");
    v.flag("model_has_background", model_has_background,
           "Channel 0 is no class; otherwise channel 0 is class 1");
    v.integer("model_width", model_width, 0, 10000, "px",
              "Size of the images that the model takes; 0 = the recording's");
    v.integer("model_height", model_height, 0, 10000, "px", "See model_width");
    v.real("model_scale", model_scale, 1e-6, 1000, "", "Factor of gray levels, RGB");
    v.real("model_mean", model_mean, -1000, 1000, "", "Subtracted before model_scale");
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
