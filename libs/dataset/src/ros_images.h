/** Pixels of ROS's image messages. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "ros_messages.h"

namespace rgbd_graphslam::ros {

/** A message's pixels as an image file. */
struct ImageFile {
    /** ".png", ".jpg", ".ppm" or ".pgm"; what came compressed keeps its bytes. */
    std::string extension;
    std::string bytes;
};

/** The encoding in front of a compressed image's format: "rgb8" of "rgb8; jpeg compressed bgr8",
 *  "jpeg" where nothing else is said. */
std::string encodingOf(const CompressedImage& image);

/** Whether the image was packed by compressed_depth_image_transport. */
bool isCompressedDepth(const CompressedImage& image);

/** Columns and rows; 0 x 0 where the bytes are neither PNG nor JPEG nor RVL. */
cv::Size sizeOf(const CompressedImage& image);

/** Encodings in lower case. */
bool isColorEncoding(const std::string& encoding);
bool isGrayEncoding(const std::string& encoding);
bool isDepthEncoding(const std::string& encoding);

/** CV_8UC3 (BGR) or CV_8UC1.
 *  \throws Error naming the stamp when the image is not whole or its encoding not known */
cv::Mat colorOf(const Image& image);
ImageFile colorFileOf(const Image& image);
ImageFile colorFileOf(const CompressedImage& image);

/** Depth in integer units; readings that are not finite or do not fit are 0.
 *  \param units per meter, for floating-point depth; integers keep their values */
cv::Mat1w depthOf(const Image& image, double units);
ImageFile depthFileOf(const Image& image, double units);
ImageFile depthFileOf(const CompressedImage& image, double units);

/** The largest finite reading of floating-point depth, m; 0 for integers. */
double largestDepth(const Image& image);
double largestDepth(const CompressedImage& image);

}  // namespace rgbd_graphslam::ros
