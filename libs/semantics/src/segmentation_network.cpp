#include "rgbd_graphslam/semantics/segmentation_network.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

const char* const remedy =
    "give [SemanticOptions] model an ONNX file whose result is 1 x classes x height x width";

/** OpenCV's explanation in one line. */
std::string reasonOf(const cv::Exception& e) {
    std::string reason = e.err;
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return reason;
}

cv::dnn::Net readNetwork(const std::string& path) {
    if (!std::filesystem::is_regular_file(path)) {
        throw Error("there is no model '" + path + "'", remedy);
    }
    try {
        return cv::dnn::readNetFromONNX(path);
    } catch (const cv::Exception& e) {
        throw Error("OpenCV cannot read the model '" + path + "': " + reasonOf(e), remedy);
    }
}

/** A plane of a result with two leading dimensions. */
cv::Mat1f plane(const cv::Mat& result, int channel) {
    return {result.size[2], result.size[3], const_cast<float*>(result.ptr<float>(0, channel))};
}

/** Of scores: the channel with the highest. */
cv::Mat1w highestChannel(const cv::Mat& scores) {
    cv::Mat1f best = plane(scores, 0).clone();
    cv::Mat1w channel(best.size(), std::uint16_t{0});
    for (int c = 1; c < scores.size[1]; ++c) {
        const cv::Mat higher = plane(scores, c) > best;
        plane(scores, c).copyTo(best, higher);
        channel.setTo(c, higher);
    }
    return channel;
}

cv::Mat1w numbersOf(const cv::Mat& result, const std::string& path) {
    if (result.dims != 4 || result.type() != CV_32F || result.size[0] != 1) {
        throw Error("the result of the model '" + path + "' is no image of scores", remedy);
    }
    if (result.size[1] > 1) return highestChannel(result);
    cv::Mat1w numbers;
    plane(result, 0).convertTo(numbers, CV_16U);
    return numbers;
}

}  // namespace

struct SegmentationNetwork::Network {
    cv::dnn::Net net;
};

SegmentationNetwork::SegmentationNetwork(const SemanticOptions& options)
    : network_(std::make_unique<Network>(Network{readNetwork(options.model)})), options_(options) {
    if (!options.model_labels.empty()) names_ = readLabelSet(options.model_labels);
}

SegmentationNetwork::~SegmentationNetwork() = default;

cv::Mat SegmentationNetwork::labelsOf(const cv::Mat& color) {
    const cv::Size size(options_.model_width, options_.model_height);
    cv::Mat result;
    try {
        network_->net.setInput(cv::dnn::blobFromImage(color, options_.model_scale,
                                                      size.area() > 0 ? size : color.size(),
                                                      cv::Scalar::all(options_.model_mean), true));
        result = network_->net.forward();
    } catch (const cv::Exception& e) {
        throw Error("the model '" + options_.model + "' fails on an image of " +
                        std::to_string(color.cols) + "x" + std::to_string(color.rows) +
                        " pixels: " + reasonOf(e),
                    "set model_width and model_height to the size that it takes");
    }
    cv::Mat labels;
    cv::resize(numbersOf(result, options_.model), labels, color.size(), 0, 0,
               cv::INTER_NEAREST_EXACT);
    if (!options_.model_has_background) labels += cv::Scalar(1);
    return labels;
}

}  // namespace rgbd_graphslam
