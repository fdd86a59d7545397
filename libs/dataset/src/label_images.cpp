#include "label_images.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

LabelImages::LabelImages(const std::string& folder) {
    const fs::path labels = fs::path(folder) / "label", names = fs::path(folder) / "labels.ini";
    if (!fs::is_directory(labels)) return;
    folder_ = labels;
    if (fs::exists(names)) names_ = readLabelSet(names);
}

cv::Mat LabelImages::of(const std::string& color_file, const cv::Size& size) const {
    const fs::path file =
        fs::path(folder_) / fs::path(color_file).filename().replace_extension(".png");
    if (folder_.empty() || !fs::exists(file)) return {};
    const DecodedImage image = readLabelImage(file);
    if (!image.damage.empty()) {
        throw Error("label image " + image.damage, "write it again, or remove it");
    }
    if (image.pixels.size() == size) return image.pixels;
    throw Error("the label image '" + file.string() + "' has " + std::to_string(image.pixels.cols) +
                    "x" + std::to_string(image.pixels.rows) + " pixels, the color images " +
                    std::to_string(size.width) + "x" + std::to_string(size.height),
                "give it the size of the color images");
}

}  // namespace rgbd_graphslam
