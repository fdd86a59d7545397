#include "rgbd_graphslam/dataset/image_output.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace rgbd_graphslam {

bool writeImageFile(const std::string& path, const cv::Mat& image,
                    const std::vector<int>& parameters) {
    std::vector<uchar> bytes;
    const std::string extension = std::filesystem::path(path).extension().string();
    if (!cv::imencode(extension, image, bytes, parameters)) return false;
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    out.close();
    return out.good();
}

}  // namespace rgbd_graphslam
