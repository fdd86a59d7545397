#include "depth_confidence.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

namespace rgbd_graphslam {
namespace fs = std::filesystem;

std::string dropUnconfident(const RgbdSequence& sequence, const std::string& depth_file,
                            cv::Mat& depth) {
    if (sequence.confidence_folder.empty()) return "";
    const std::string path =
        fs::path(sequence.folder) / sequence.confidence_folder / fs::path(depth_file).filename();
    cv::Mat confidence;
    try {
        if (fs::is_regular_file(path)) confidence = cv::imread(path, cv::IMREAD_GRAYSCALE);
    } catch (const cv::Exception&) {
        confidence.release();
    }
    if (confidence.empty()) return "'" + path + "' is missing or no image";
    if (confidence.size() != depth.size()) return "'" + path + "' differs from its depth in size";
    depth.setTo(0, confidence == 0);
    return "";
}

}  // namespace rgbd_graphslam
