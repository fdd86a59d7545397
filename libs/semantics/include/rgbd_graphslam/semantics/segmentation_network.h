/** Labels of images by a network of the user's. */
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "rgbd_graphslam/dataset/label_set.h"
#include "rgbd_graphslam/semantics/semantic_options.h"

namespace rgbd_graphslam {

/** A semantic segmentation model in ONNX, evaluated by OpenCV's `dnn` module on the CPU. */
class SegmentationNetwork {
  public:
    /** \throws Error naming the file that is missing, no ONNX model, or uses what OpenCV lacks */
    explicit SegmentationNetwork(const SemanticOptions& options);
    ~SegmentationNetwork();

    /** The names of `model_labels`; empty without that file. */
    const LabelSet& names() const { return names_; }

    /** \param color CV_8UC3, BGR
     *  \return CV_16UC1 of the image's size: the number of the channel with the highest score, or
     *          what the model's last layer has as number, plus one unless channel 0 is the
     *          background
     *  \throws Error when the model fails, or its result is no image of scores or numbers */
    cv::Mat labelsOf(const cv::Mat& color);

  private:
    struct Network;
    std::unique_ptr<Network> network_;
    SemanticOptions options_;
    LabelSet names_;
};

}  // namespace rgbd_graphslam
