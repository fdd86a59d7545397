/** Image files of RGB-D sequences, checked to be what they should be. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace rgbd_graphslam {

/** An image that cannot be decoded is not an exception: a long sequence may afford to lose one. */
struct DecodedImage {
    cv::Mat pixels;
    /** Why there are no pixels, empty otherwise. */
    std::string damage;
    /** Depth that came in meters. */
    bool converted = false;
};

/** Decodes PNG or JPEG to CV_8UC3, BGR, in the sensor's orientation. */
DecodedImage readColorImage(const std::string& path);

/** As readColorImage, but gray images become CV_8UC1, those of 16 bits, too. */
DecodedImage readGrayOrColorImage(const std::string& path);

/** Decodes a 16-bit PNG, TIFF or PGM to CV_16UC1; a 32-bit float TIFF in meters is converted.
 *  \param units of the result per meter, for float images
 *  \throws Error for whole images of another kind: 8 bit, OpenEXR, several channels */
DecodedImage readDepthImage(const std::string& path, double units = 5000);

/** Decodes a PNG of class numbers, 8 or 16 bit, to CV_16UC1.
 *  \throws Error for whole images of another kind: color images, palettes */
DecodedImage readLabelImage(const std::string& path);

}  // namespace rgbd_graphslam
