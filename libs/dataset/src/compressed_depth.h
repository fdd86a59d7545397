/** Depth packed by ROS's compressed_depth_image_transport. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace rgbd_graphslam {

/** Twelve bytes of settings, then a 16-bit PNG or, where the format says `rvl`, columns, rows and
 *  RVL data (A. Wilson, "Fast lossless depth image compression", ISS 2017). Integers keep their
 *  values; floating-point depth is quantized by its inverse, value = A / depth + B. */
class CompressedDepth {
  public:
    /** \param bytes must outlive this object
     *  \param format e.g. "16UC1; compressedDepth png" */
    CompressedDepth(std::string_view bytes, const std::string& format);

    /** Of floating-point depth. */
    bool isQuantized() const { return is_quantized_; }
    bool isPng() const { return !is_rvl_; }
    /** What follows the settings. */
    std::string_view payload() const { return payload_; }

    /** Columns and rows; 0 x 0 where they cannot be told. */
    cv::Size size() const;

    /** CV_16UC1, empty when the bytes are damaged. */
    cv::Mat decoded() const;
    /** CV_32FC1; readings that were none are 0. \param values as decoded */
    cv::Mat inMetres(const cv::Mat& values) const;

  private:
    bool sizeIsPlausible() const;

    bool is_rvl_ = false, is_quantized_ = false;
    float quantum_a_ = 0, quantum_b_ = 0;
    std::string_view payload_;
};

/** \param data 16-bit RVL words \return CV_16UC1, empty when they end too early */
cv::Mat decodeRvl(std::string_view data, cv::Size size);

}  // namespace rgbd_graphslam
